// SPDX-License-Identifier: Apache-2.0
/// @file Recorded cycles from JSON. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/recording/record_json.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace articula {

/// A record from the JSON that record_json() made of it, with the same bits. Numbers that are null
/// are NaN: they were NaN or infinite.
/// @param robot  whose joints these are
/// @param json   an object; more members than needed are no mistake
/// @throws nlohmann::json::exception naming what is missing, or of another type
/// Real-time: no (allocates, throws).
template <class Command, Robot R>
[[nodiscard]] CycleRecord<joint_count<R>, Command> record_from_json(const R& robot,
                                                                    const Json& json) {
  const auto number = [](const Json& object, const char* name) {
    const Json& value = object.at(name);
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
  };
  CycleRecord<joint_count<R>, Command> record;
  record.cycle = json.at("cycle").get<std::uint64_t>();
  record.time = number(json, "timestamp");
  record.status = static_cast<Status>(json.at("status_number").get<int>());
  const auto& model = model_of(robot);
  const Json& joints = json.at(std::string(model.name.view()));
  const auto parts = parts_of(record.command);
  for (int j = 0; j < joint_count<R>; ++j) {
    const Json& joint =
        joints.at(std::string(model.joints[static_cast<std::size_t>(j)].name.view()));
    record.state.position[j] = number(joint, "position");
    record.state.velocity[j] = number(joint, "velocity");
    record.state.effort[j] = number(joint, "effort");
    const Json& reference = joint.at("reference");
    record.reference.position[j] = number(reference, "position");
    record.reference.velocity[j] = number(reference, "velocity");
    record.reference.acceleration[j] = number(reference, "acceleration");
    record.reference.effort[j] = number(reference, "effort");
    for (const auto& part : parts) {
      const bool alone = parts.size() == 1;
      const std::string member = alone ? "command" : std::string(to_string(part.quantity));
      const double value = number(alone ? joint : joint.at("command"), member.c_str());
      (*part_of(record.command, part.quantity))[j] = value;
    }
  }
  const auto nanoseconds = [&](const char* name) {
    return std::chrono::nanoseconds(std::llround(number(json.at("timing"), name) * 1e9));
  };
  record.timing = {nanoseconds("latency"), nanoseconds("period"), nanoseconds("update")};
  const Json& input = json.at("input");
  const auto whole = [&](const char* name) { return input.at(name).get<std::uint64_t>(); };
  record.input = {.read = static_cast<Status>(whole("read")),
                  .write = static_cast<Status>(whole("write")),
                  .request = static_cast<LoopRequest>(whole("request")),
                  .change = static_cast<Status>(whole("change")),
                  .posted = whole("posted") != 0,
                  .overruns = static_cast<std::uint32_t>(whole("overruns")),
                  .missed = whole("missed")};
  return record;
}

}  // namespace articula
