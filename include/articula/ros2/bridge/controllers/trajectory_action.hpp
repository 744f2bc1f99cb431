// SPDX-License-Identifier: Apache-2.0
/// @file The action follow_joint_trajectory of a controller.
#pragma once

#include "articula/ros2/bridge/controllers/controller_action.hpp"
#include "articula/ros2/bridge/core/bridge_core.hpp"

#include <memory>

namespace articula::ros2 {

/// Follows trajectories as the joint_trajectory_controller's action server does: goals are accepted
/// if their controller is active and the loop can follow them. A new goal replaces the last one.
/// Error codes and texts of results are those of joint_trajectory_controller. The layout is that of
/// the distribution.
/// @param core        outlives it
/// @param node        the controller's, likewise
/// @param controller  likewise
/// Real-time: no (allocates).
[[nodiscard]] std::unique_ptr<ControllerAction> make_trajectory_action(
    BridgeCore& core, const Node& node, const BridgedController& controller);

}  // namespace articula::ros2
