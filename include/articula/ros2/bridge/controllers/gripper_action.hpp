// SPDX-License-Identifier: Apache-2.0
/// @file The action gripper_cmd of a controller.
#pragma once

#include "articula/ros2/bridge/controllers/controller_action.hpp"
#include "articula/ros2/bridge/core/bridge_core.hpp"

#include <memory>

namespace articula::ros2 {

/// Moves a gripper's joint as the action servers of ros2_controllers do: GripperCommand, or
/// ParallelGripperCommand if the controller's type is a parallel gripper's.
///
/// - The reference goes to the position within the loop's limits of velocity, acceleration and
///   jerk. A velocity of the command lowers the velocity.
/// - The goal ends when the joint is within goal_tolerance, or has been stalled for stall_timeout.
/// - A new goal replaces the last one. A canceled goal leaves the joint where it is.
/// - A loop has no limit of effort for one goal. So a max_effort below the joint's limit is
///   refused.
///
/// @param core        outlives it
/// @param node        the controller's, likewise
/// @param controller  likewise; it has `gripper`
/// Real-time: no (allocates).
[[nodiscard]] std::unique_ptr<ControllerAction> make_gripper_action(
    BridgeCore& core, const Node& node, const BridgedController& controller);

}  // namespace articula::ros2
