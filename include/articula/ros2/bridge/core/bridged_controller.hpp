// SPDX-License-Identifier: Apache-2.0
/// @file The controllers of a loop as ROS sees them.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/ros2/bridge/core/bridge_options.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::ros2 {

/// A controller of a loop as ROS sees it.
struct BridgedController {
  std::string name{};  ///< of the controller
  std::string node{};  ///< the same in characters that ROS allows; of a group as "arm/pid"
  std::string type{};  ///< as joint_trajectory_controller/JointTrajectoryController
  std::vector<std::string> joints{};   ///< those that it commands
  std::vector<std::size_t> indices{};  ///< of these joints in the robot
  std::string quantity{};              ///< of <controller>/commands
  std::string gain_prefix{};           ///< of its gains' parameters
  TrajectoryConstraints constraints{};
  std::optional<GripperOptions> gripper{};  ///< with its joint, if the type is a gripper's
};

/// A name in the characters of ROS names: letters, digits, underscores, no digit first.
[[nodiscard]] inline std::string ros_name(std::string_view name) {
  std::string text(name);
  for (char& c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  if (text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0)
    text = "_" + text;
  return text;
}

/// The same for each part of a name that slashes separate.
[[nodiscard]] inline std::string ros_path(std::string_view name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos) return ros_name(name);
  return ros_name(name.substr(0, slash)) + "/" + ros_path(name.substr(slash + 1));
}

/// The indices of joints in a robot, in their order.
/// @throws std::invalid_argument if the robot has no such joint
/// Real-time: no (allocates).
[[nodiscard]] inline std::vector<std::size_t> indices_of(const remote::RobotSheet& robot,
                                                         const BridgedController& own) {
  std::vector<std::size_t> indices;
  for (const std::string& name : own.joints) {
    const auto found = std::find_if(robot.joints.begin(), robot.joints.end(),
                                    [&](const auto& joint) { return joint.name == name; });
    if (found == robot.joints.end()) {
      articula::detail::refuse({"ros2: controller '", own.name, "' has the joint '", name,
                                "', which robot '", robot.name, "' does not have"});
    }
    indices.push_back(static_cast<std::size_t>(found - robot.joints.begin()));
  }
  return indices;
}

/// The options of a gripper's controller, with its joint.
/// @throws std::invalid_argument if the controller has no such joint, or several and none is named
/// Real-time: no (allocates).
[[nodiscard]] inline GripperOptions gripper_of(const BridgedController& own,
                                               GripperOptions gripper) {
  if (gripper.joint.empty() && own.joints.size() == 1) gripper.joint = own.joints[0];
  if (std::find(own.joints.begin(), own.joints.end(), gripper.joint) == own.joints.end()) {
    std::string joints;
    for (const std::string& joint : own.joints) joints += (joints.empty() ? "" : ", ") + joint;
    articula::detail::refuse({"ros2: gripper '", own.name, "' has the joints ", joints, ", not '",
                              gripper.joint, "': name one of them as its joint"});
  }
  return gripper;
}

/// The constraints of a controller that the options give, or the tolerances of the Remote.
/// @throws std::invalid_argument if the options have another number of joints
/// Real-time: no (allocates).
[[nodiscard]] inline TrajectoryConstraints constraints_of(const remote::RobotSheet& robot,
                                                          const BridgedController& own,
                                                          const ControllerOptions& options) {
  if (options.constraints) {
    TrajectoryConstraints constraints = *options.constraints;
    if (constraints.joints.empty()) constraints.joints.resize(own.joints.size());
    if (constraints.joints.size() == own.joints.size()) return constraints;
    articula::detail::refuse({"ros2: constraints of '", own.name, "' are for ",
                              constraints.joints.size(), " joints, not ", own.joints.size()});
  }
  TrajectoryConstraints constraints{.goal_time = robot.goal_time};
  for (const std::size_t index : own.indices) {
    const remote::SheetJoint& joint = robot.joints[index];
    constraints.joints.push_back(
        {joint.path_tolerance, joint.goal_tolerance, joint.stopped_velocity});
  }
  return constraints;
}

/// A controller of a port, with the joints that its options name. Otherwise one with gains commands
/// the joints of its gains, and others command all. A gripper's commands one.
/// @throws std::invalid_argument as gripper_of, indices_of and constraints_of
/// Real-time: no (allocates).
[[nodiscard]] inline BridgedController bridged_controller(remote::Port& port,
                                                          const std::string& name,
                                                          const BridgeOptions& options) {
  const auto found = options.controllers.find(name);
  const ControllerOptions wanted =
      found == options.controllers.end() ? ControllerOptions{} : found->second;
  BridgedController own{.name = name, .node = ros_path(name), .joints = wanted.joints};
  std::vector<std::string> joints, joints_with_gains;
  const auto parameters = port.parameters();
  for (const remote::SheetJoint& joint : port.robot().joints) {
    const std::string prefix = name + "." + joint.name + ".";
    const bool has_gains = std::any_of(parameters.begin(), parameters.end(),
                                       [&](const auto& p) { return p.name.starts_with(prefix); });
    joints.push_back(joint.name);
    if (has_gains) joints_with_gains.push_back(joint.name);
  }
  own.type = wanted.type.empty() ? options.controller_type : wanted.type;
  own.quantity = !wanted.command_quantity.empty() ? wanted.command_quantity
                 : joints_with_gains.empty()      ? "effort"
                                                  : "position";
  own.gain_prefix = wanted.gain_prefix.value_or(options.gain_prefix);
  if (own.joints.empty()) own.joints = joints_with_gains.empty() ? joints : joints_with_gains;
  if (is_gripper(own.type)) {
    own.gripper = gripper_of(own, wanted.gripper);
    own.joints = {own.gripper->joint};
  } else if (wanted.gripper != GripperOptions{}) {
    articula::detail::refuse({"ros2: controller '", name,
                              "' has options of a gripper, but its type, ", own.type, ", is none"});
  }
  own.indices = indices_of(port.robot(), own);
  own.constraints = constraints_of(port.robot(), own, wanted);
  return own;
}

/// All controllers of a port.
/// @throws std::invalid_argument as bridged_controller; if an option names another controller; if
///         two names are the same in ROS
/// Real-time: no (allocates).
[[nodiscard]] inline std::vector<BridgedController> bridged_controllers(
    remote::Port& port, const BridgeOptions& options) {
  std::vector<BridgedController> all;
  std::vector<std::string_view> names;
  const auto known = port.situation().controllers;
  for (const ControllerInfo& info : known) names.push_back(info.name.view());
  for (const auto& [name, wanted] : options.controllers) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    articula::detail::refuse({"ros2: the options are for a controller '", name,
                              "', which the loop does not list",
                              articula::detail::choice_of(name, "controllers", names)});
  }
  for (const std::string_view name : names) {
    BridgedController own = bridged_controller(port, std::string(name), options);
    for (const BridgedController& other : all) {
      if (other.node != own.node) continue;
      articula::detail::refuse({"ros2: the controllers '", other.name, "' and '", own.name,
                                "' have the same name in ROS, ", own.node});
    }
    all.push_back(std::move(own));
  }
  return all;
}

}  // namespace articula::ros2
