// SPDX-License-Identifier: Apache-2.0
/// @file Recorded cycles as JSON. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/command/command_parts.hpp"
#include "articula/model/robot.hpp"
#include "articula/recording/cycle_record.hpp"
#include "articula/recording/record_extras.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace articula {

/// JSON whose members stay in the order in which they were written.
using Json = nlohmann::ordered_json;

namespace detail {

/// The member of a joint in the JSON of a robot; an empty one if there is none.
template <Robot R>
[[nodiscard]] Json& member_of(Json& json, const R& robot, int joint) {
  const auto& model = model_of(robot);
  const std::string_view name = model.joints[joint].name.view();
  return json[std::string(model.name.view())][std::string(name)];
}

}  // namespace detail

/// The joint states by joint names, with the time under the name that PlotJuggler expects:
///
///     {"timestamp": 0.02, "q2d": {"shoulder_active_joint": {"position": 0.1, ...}, ...}}
///
/// NaN and infinity become null, since JSON has neither.
/// @param robot  whose joints these are
/// @param time   [s]
/// @param state  of the joints
/// Real-time: no (allocates).
template <Robot R>
[[nodiscard]] Json joint_state_json(const R& robot, double time,
                                    const JointState<joint_count<R>>& state) {
  Json json{{"timestamp", time}};
  for (int j = 0; j < joint_count<R>; ++j) {
    detail::member_of(json, robot, j) = {{"position", state.position[j]},
                                         {"velocity", state.velocity[j]},
                                         {"effort", state.effort[j]}};
  }
  return json;
}

/// Adds a member "reference" to each joint of the JSON of joint_state_json(): position, velocity,
/// acceleration and effort.
/// Real-time: no (allocates).
template <Robot R>
void add_references(const R& robot, Json& json, const JointReference<joint_count<R>>& reference) {
  for (int j = 0; j < joint_count<R>; ++j) {
    detail::member_of(json, robot, j)["reference"] = {{"position", reference.position[j]},
                                                      {"velocity", reference.velocity[j]},
                                                      {"acceleration", reference.acceleration[j]},
                                                      {"effort", reference.effort[j]}};
  }
}

/// Adds mimic joints and link poses: to the joints the position and the velocity of each mimic
/// joint, and a member "links" with
///
///     {"tool_link": {"translation": {"x": ..., "y", "z"}, "rotation": {"x", "y", "z", "w"}}}
///
/// with the pose in the root link's frame: position [m] and a unit quaternion.
/// Real-time: no (allocates).
template <Robot R>
void add_extras(const R& robot, Json& json, const RecordExtras<R>& extras,
                const JointState<joint_count<R>>& state) {
  Json& joints = json[std::string(model_of(robot).name.view())];
  const auto q = moving_joint_positions(robot, state.position);
  const auto v = moving_joint_velocities(robot, state.velocity);
  for (const MimicJoint& joint : extras.mimic_joints) {
    joints[joint.name] = {{"position", q[joint.index]}, {"velocity", v[joint.index]}};
  }
  for (const RecordedLink& link : extras.links) {
    const Eigen::Isometry3d pose = forward_kinematics(robot, state.position, link.index);
    const Eigen::Vector3d p = pose.translation();
    const Eigen::Quaterniond rotation(pose.linear());
    json["links"][link.name] = {
        {"translation", {{"x", p.x()}, {"y", p.y()}, {"z", p.z()}}},
        {"rotation",
         {{"x", rotation.x()}, {"y", rotation.y()}, {"z", rotation.z()}, {"w", rotation.w()}}}};
  }
}

/// A whole record: states, references, commands, mimic joints and link poses; status, timing [s]
/// and input, with the numbers of CycleInput.
/// @param robot   whose joints these are
/// @param record  of one cycle
/// @param extras  mimic joints and links to add
/// Real-time: no (allocates).
template <Robot R, class Command>
[[nodiscard]] Json record_json(const R& robot, const CycleRecord<joint_count<R>, Command>& record,
                               const RecordExtras<R>& extras) {
  const auto seconds = [](std::chrono::nanoseconds duration) {
    return std::chrono::duration<double>(duration).count();
  };
  Json json = joint_state_json(robot, record.time, record.state);
  add_references(robot, json, record.reference);
  const auto parts = parts_of(record.command);
  for (int j = 0; j < joint_count<R>; ++j) {
    Json& command = detail::member_of(json, robot, j)["command"];
    for (const auto& part : parts) {
      const bool alone = parts.size() == 1;
      (alone ? command : command[std::string(to_string(part.quantity))]) = (*part.values)[j];
    }
  }
  json["cycle"] = record.cycle;
  json["status"] = std::string(to_string(record.status));
  json["status_number"] = static_cast<int>(record.status);
  json["timing"] = {{"latency", seconds(record.timing.latency)},
                    {"period", seconds(record.timing.period)},
                    {"update", seconds(record.timing.update)}};
  const CycleInput& input = record.input;
  json["input"] = {{"read", static_cast<int>(input.read)},
                   {"write", static_cast<int>(input.write)},
                   {"request", static_cast<int>(input.request)},
                   {"change", static_cast<int>(input.change)},
                   {"posted", input.posted ? 1 : 0},
                   {"overruns", input.overruns},
                   {"missed", input.missed}};
  add_extras(robot, json, extras, record.state);
  return json;
}

/// The JSON Schema of objects with the same members and types as an example.
/// Real-time: no (allocates).
[[nodiscard]] inline Json schema_of(const Json& example) {
  if (!example.is_object()) return {{"type", example.is_string() ? "string" : "number"}};
  Json properties = Json::object();
  for (const auto& [name, member] : example.items()) properties[name] = schema_of(member);
  return {{"type", "object"}, {"properties", properties}};
}

}  // namespace articula
