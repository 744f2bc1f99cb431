// SPDX-License-Identifier: Apache-2.0
/// @file The messages that a view publishes many times a second. Those in JSON are written without
/// a JSON document in between, since a PR2 at 1 kHz has 400 000 numbers a second.
#pragma once

#include "articula/remote/cycle.hpp"
#include "articula/remote/port.hpp"
#include "articula/remote/sheet/robot_sheet.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace articula::view {

/// Time since 1970 [ns].
using WallTime = std::uint64_t;

/// sensor_msgs/JointState of a cycle, mimic joints included.
[[nodiscard]] std::string joint_states_message(const remote::RobotSheet& robot,
                                               const remote::Cycle& cycle, WallTime stamp);

/// sensor_msgs/msg/JointState of ROS 2 in CDR: the measured state of a cycle, mimic joints
/// included.
[[nodiscard]] std::string ros_states_message(const remote::RobotSheet& robot,
                                             const remote::Cycle& cycle, WallTime stamp);
/// Likewise the reference of a cycle.
[[nodiscard]] std::string ros_reference_message(const remote::RobotSheet& robot,
                                                const remote::Cycle& cycle, WallTime stamp);
/// Likewise the command of a cycle. Quantities that are not commanded are empty.
[[nodiscard]] std::string ros_command_message(const remote::RobotSheet& robot,
                                              const remote::Cycle& cycle, WallTime stamp);

/// foxglove.FrameTransforms: each link but the root in the root link's frame.
[[nodiscard]] std::string transforms_message(const std::vector<remote::LinkPose>& poses,
                                             const std::string& root, WallTime stamp);

/// articula.Cycles: some cycles in columns.
/// @param dropped  number of cycles that were lost before the first of these
[[nodiscard]] std::string cycles_message(const remote::RobotSheet& robot,
                                         std::span<const remote::Cycle> cycles,
                                         std::uint64_t dropped);

}  // namespace articula::view
