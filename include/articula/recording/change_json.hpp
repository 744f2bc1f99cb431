// SPDX-License-Identifier: Apache-2.0
/// @file Changes of a loop as JSON. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/recording/loop_change.hpp"
#include "articula/recording/record_json.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace articula {

/// A gain as JSON: a number, or the text "inf" or "-inf".
/// Real-time: no (allocates).
[[nodiscard]] inline Json gain_json(double gain) {
  if (!std::isinf(gain)) return gain;
  return gain > 0 ? "inf" : "-inf";
}

/// The gain of such JSON; nothing if it is none.
/// @tparam AnyJson  a kind of nlohmann::basic_json
template <class AnyJson>
[[nodiscard]] std::optional<double> gain_of_json(const AnyJson& json) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (json.is_number()) return json.template get<double>();
  if (json == "inf") return infinity;
  if (json == "-inf") return -infinity;
  return std::nullopt;
}

/// A change of a loop, without the number of its cycle:
///
///     {"gains": {"pid.elbow.p": 5}}    {"start": ["pid"], "stop": ["bypass"], "replace": true}
///
/// Real-time: no (allocates).
[[nodiscard]] inline Json change_json(const LoopChange& change) {
  Json json = Json::object();
  for (const GainSetting& gain : change.gains) {
    json["gains"][gain.parameter] = gain_json(gain.value);
  }
  if (!is_empty(change.request)) {
    json["start"] = json["stop"] = Json::array();
    for (const Name& name : change.request.start) json["start"].push_back(std::string(name.view()));
    for (const Name& name : change.request.stop) json["stop"].push_back(std::string(name.view()));
    json["best_effort"] = change.request.strictness == Strictness::best_effort;
    json["replace"] = change.request.replace;
  }
  return json;
}

/// The change of such JSON.
/// @param cycle  in which it has effect first
/// @throws nlohmann::json::exception if a member is missing or of another type
/// @throws std::length_error if a name or a list is too long
/// Real-time: no (allocates, throws).
[[nodiscard]] inline LoopChange change_of_json(std::uint64_t cycle, const Json& json) {
  LoopChange change{.cycle = cycle};
  if (json.contains("gains")) {
    for (const auto& [name, value] : json.at("gains").items()) {
      const auto number = gain_of_json(value);
      change.gains.push_back({name, number ? *number : value.get<double>()});
    }
  }
  if (json.contains("start")) {
    const auto names = [&](const char* list) {
      std::vector<Name> all;
      for (const Json& name : json.at(list)) all.emplace_back(name.get<std::string>());
      return ControllerNames(all);
    };
    change.request = {.stop = names("stop"),
                      .start = names("start"),
                      .strictness = json.at("best_effort").get<bool>() ? Strictness::best_effort
                                                                       : Strictness::strict,
                      .replace = json.at("replace").get<bool>()};
  }
  return change;
}

}  // namespace articula
