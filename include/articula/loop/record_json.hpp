// SPDX-License-Identifier: Apache-2.0
/// @file Records as JSON. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/core/command_parts.hpp"
#include "articula/loop/cycle_record.hpp"
#include "articula/model/robot.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <concepts>
#include <cstddef>
#include <string>

namespace articula {

/// JSON whose members stay in the order in which they were written.
using Json = nlohmann::ordered_json;

/// What is measured at the joints, by their names, with the time as PlotJuggler looks for it:
///
///     {"timestamp": 0.02, "q2d": {"shoulder_active_joint": {"position": 0.1, ...}, ...}}
///
/// NaN and infinity, for which JSON has no words, are null.
/// @param robot  whose joints these are
/// @param time   [s]
/// @param state  of the joints
/// Real-time: no (allocates).
template <Robot R>
[[nodiscard]] Json joint_state_json(const R& robot, double time,
                                    const JointState<joint_count<R>>& state) {
  Json joints;
  for (int j = 0; j < joint_count<R>; ++j) {
    joints[std::string(model_of(robot).joints[static_cast<std::size_t>(j)].name.view())] = {
        {"position", state.position[j]},
        {"velocity", state.velocity[j]},
        {"effort", state.effort[j]}};
  }
  return {{"timestamp", time}, {std::string(model_of(robot).name.view()), joints}};
}

/// A whole record: the above, and with each joint its reference and command, then status and
/// timing.
/// @param robot   whose joints these are
/// @param record  of one cycle
/// Real-time: no (allocates).
template <Robot R, class Command>
[[nodiscard]] Json record_json(const R& robot, const CycleRecord<joint_count<R>, Command>& record) {
  const auto seconds = [](std::chrono::nanoseconds duration) {
    return std::chrono::duration<double>(duration).count();
  };
  Json json = joint_state_json(robot, record.time, record.state);
  Json& joints = json[std::string(model_of(robot).name.view())];
  for (int j = 0; j < joint_count<R>; ++j) {
    Json& joint =
        joints[std::string(model_of(robot).joints[static_cast<std::size_t>(j)].name.view())];
    joint["reference"] = {{"position", record.reference.position[j]},
                          {"velocity", record.reference.velocity[j]},
                          {"acceleration", record.reference.acceleration[j]},
                          {"effort", record.reference.effort[j]}};
    const auto parts = parts_of(record.command);
    for (const auto& part : parts) {
      const double value = (*part.values)[j];
      if (parts.size() == 1) {
        joint["command"] = value;
      } else {
        joint["command"][std::string(to_string(part.quantity))] = value;
      }
    }
  }
  json["cycle"] = record.cycle;
  json["status"] = std::string(to_string(record.status));
  json["status_number"] = static_cast<int>(record.status);
  json["timing"] = {{"latency", seconds(record.timing.latency)},
                    {"period", seconds(record.timing.period)},
                    {"update", seconds(record.timing.update)}};
  return json;
}

/// The JSON Schema that JSON like this one has: an object or a value, its kind and its members.
/// Real-time: no (allocates).
[[nodiscard]] inline Json schema_of(const Json& example) {
  if (!example.is_object()) return {{"type", example.is_string() ? "string" : "number"}};
  Json properties = Json::object();
  for (const auto& [name, member] : example.items()) properties[name] = schema_of(member);
  return {{"type", "object"}, {"properties", properties}};
}

}  // namespace articula
