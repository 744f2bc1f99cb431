// SPDX-License-Identifier: Apache-2.0
/// @file The controllers of a loop as ROS sees them.
#pragma once

#include "articula/remote/port.hpp"
#include "articula/ros2/bridge/core/bridge_options.hpp"
#include "articula/ros2/bridge/core/trajectory_constraints.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::ros2 {

/// A controller of a loop as ROS sees it.
struct BridgedController {
  std::string name{};                  ///< of the controller
  std::string node{};                  ///< the same in characters that ROS allows
  std::string type{};                  ///< as joint_trajectory_controller/JointTrajectoryController
  std::vector<std::string> joints{};   ///< those that it commands
  std::vector<std::size_t> indices{};  ///< of these joints in the robot
  std::string quantity{};              ///< of <controller>/commands
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
                                               const BridgeOptions& options) {
  const auto found = options.grippers.find(own.name);
  GripperOptions gripper = found == options.grippers.end() ? GripperOptions{} : found->second;
  if (gripper.joint.empty() && own.joints.size() == 1) gripper.joint = own.joints[0];
  if (std::find(own.joints.begin(), own.joints.end(), gripper.joint) == own.joints.end()) {
    std::string joints;
    for (const std::string& joint : own.joints) joints += (joints.empty() ? "" : ", ") + joint;
    articula::detail::refuse({"ros2: gripper '", own.name, "' has the joints ", joints, ", not '",
                              gripper.joint, "': name one of them in BridgeOptions::grippers"});
  }
  return gripper;
}

/// The controllers of a port, with the joints that the options name. Otherwise one with gains
/// commands the joints of its gains, and others command all. A gripper's commands one.
/// @throws std::invalid_argument as gripper_of and indices_of
/// Real-time: no (allocates).
[[nodiscard]] inline std::vector<BridgedController> bridged_controllers(
    remote::Port& port, const BridgeOptions& options) {
  std::vector<BridgedController> all;
  const auto parameters = port.parameters();
  for (const ControllerInfo& info : port.situation().controllers) {
    BridgedController own{.name = std::string(info.name.view()),
                          .node = ros_name(info.name.view())};
    for (const remote::SheetJoint& joint : port.robot().joints) {
      const std::string prefix = own.name + "." + joint.name + ".";
      const bool has_gains = std::any_of(parameters.begin(), parameters.end(),
                                         [&](const auto& p) { return p.name.starts_with(prefix); });
      if (has_gains) own.joints.push_back(joint.name);
    }
    const auto type = options.controller_types.find(own.name);
    own.type = type == options.controller_types.end() ? options.controller_type : type->second;
    const auto quantity = options.command_quantities.find(own.name);
    if (quantity != options.command_quantities.end()) {
      own.quantity = quantity->second;
    } else {
      own.quantity = own.joints.empty() ? "effort" : "position";
    }
    const auto joints = options.controller_joints.find(own.name);
    if (joints != options.controller_joints.end()) own.joints = joints->second;
    if (own.joints.empty()) {
      for (const remote::SheetJoint& joint : port.robot().joints) own.joints.push_back(joint.name);
    }
    if (is_gripper(own.type)) {
      own.gripper = gripper_of(own, options);
      own.joints = {own.gripper->joint};
    }
    own.indices = indices_of(port.robot(), own);
    own.constraints.joints.resize(own.joints.size());
    all.push_back(std::move(own));
  }
  return all;
}

}  // namespace articula::ros2
