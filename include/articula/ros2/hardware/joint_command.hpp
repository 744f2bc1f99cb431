// SPDX-License-Identifier: Apache-2.0
/// @file What a message of joint commands asks of a robot.
#pragma once

#include "articula/remote/request.hpp"
#include "articula/remote/sheet/robot_sheet.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::ros2::detail {

/// The part of a message that one robot can do.
struct JointCommand {
  enum class Kind : unsigned char {
    usable,
    unusable,   ///< It has no number of the quantities that the robot's drives take.
    foreign,    ///< It names no joint of the robot.
    malformed,  ///< Its fields differ in length, or it names one of the robot's joints twice.
  };
  Kind kind = Kind::usable;
  remote::SetReference reference{};

  [[nodiscard]] static bool is_any(const std::vector<remote::JointValue>& values) {
    return std::any_of(values.begin(), values.end(),
                       [](const remote::JointValue& own) { return own.value != 0; });
  }
  /// Whether joints go on until another command stops them.
  [[nodiscard]] bool moves() const { return is_any(reference.velocities); }
  [[nodiscard]] bool pushes() const { return is_any(reference.efforts); }
};

/// Reads a message. NaN leaves a joint as it is; so do quantities that the drives do not take.
/// Real-time: no (allocates).
[[nodiscard]] inline JointCommand read_joint_command(
    const sensor_msgs::msg::JointState<Jazzy>& message, const remote::RobotSheet& robot) {
  using Kind = JointCommand::Kind;
  const std::size_t size = message.name.size();
  for (const auto* field : {&message.position, &message.velocity, &message.effort}) {
    if (!field->empty() && field->size() != size) return {Kind::malformed};
  }
  std::vector<std::size_t> own;  // where the message has joints of the robot
  for (std::size_t i = 0; i < size; ++i) {
    const std::string& name = message.name[i];
    if (std::none_of(robot.joints.begin(), robot.joints.end(),
                     [&](const remote::SheetJoint& joint) { return joint.name == name; })) {
      continue;
    }
    for (const std::size_t other : own) {
      if (message.name[other] == name) return {Kind::malformed};
    }
    own.push_back(i);
  }
  if (own.empty()) return {Kind::foreign};

  const auto named = [&](std::string_view quantity, const std::vector<double>& values) {
    std::vector<remote::JointValue> all;
    const auto& taken = robot.commands;
    if (values.empty() || std::find(taken.begin(), taken.end(), quantity) == taken.end()) {
      return all;
    }
    for (const std::size_t i : own) {
      if (!std::isnan(values[i])) all.push_back({message.name[i], values[i]});
    }
    return all;
  };
  JointCommand command{.reference = {.positions = named("position", message.position),
                                     .velocities = named("velocity", message.velocity),
                                     .efforts = named("effort", message.effort)}};
  const remote::SetReference& all = command.reference;
  if (all.positions.empty() && all.velocities.empty() && all.efforts.empty()) {
    command.kind = Kind::unusable;
  }
  return command;
}

}  // namespace articula::ros2::detail
