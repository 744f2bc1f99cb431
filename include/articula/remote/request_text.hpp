// SPDX-License-Identifier: Apache-2.0
/// @file Requests in words, as the log lists them.
#pragma once

#include "articula/remote/request.hpp"
#include "articula/text/numbers.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace articula::remote {

/// The name of a request, as in the log.
[[nodiscard]] inline std::string_view name_of(const Request& request) {
  constexpr std::array<std::string_view, std::variant_size_v<Request>> names{
      "activate",
      "deactivate",
      "acknowledge_fault",
      "go",
      "set_reference",
      "play_trajectory",
      "play_signals",
      "stop",
      "switch_controllers",
      "set_parameters",
      "pause",
      "step",
      "set_speed",
      "reset",
      "pull",
      "set_trajectory_speed"};
  return names[request.index()];
}

/// Whether a request comes so often that the log does not list it.
[[nodiscard]] inline bool is_frequent(const Request& request) {
  return std::holds_alternative<SetReference>(request) || std::holds_alternative<Pull>(request) ||
         std::holds_alternative<Go>(request);
}

/// A request with what it changes, as "set_parameters pid.elbow.p = 300"; of many gains,
/// controllers or joints the first four.
[[nodiscard]] inline std::string in_words(const Request& request) {
  constexpr std::size_t most = 4;
  std::string text(name_of(request));
  const auto add = [&](const char* before, const auto& list, auto&& text_of) {
    for (std::size_t k = 0; k < list.size() && k < most; ++k) {
      text += (k == 0 ? before : std::string(", ")) + text_of(list[k]);
    }
    if (list.size() > most) text += " and " + std::to_string(list.size() - most) + " more";
  };
  const auto same = [](const std::string& name) { return name; };
  if (const auto* set = std::get_if<SetParameters>(&request)) {
    add(" ", set->values, [](const ParameterValue& own) {
      return own.name + " = " + articula::detail::number_text(own.value);
    });
  } else if (const auto* change = std::get_if<SwitchControllers>(&request)) {
    add(" start ", change->start, same);
    add(" stop ", change->stop, same);
  } else if (const auto* play = std::get_if<PlayTrajectory>(&request)) {
    add(" of ", play->trajectory.joint_names, same);
  } else if (const auto* speed = std::get_if<SetTrajectorySpeed>(&request)) {
    text += " " + articula::detail::number_text(speed->factor);
  }
  return text;
}

}  // namespace articula::remote
