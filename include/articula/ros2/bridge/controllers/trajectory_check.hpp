// SPDX-License-Identifier: Apache-2.0
/// @file The check of the joints of a trajectory before a loop gets it.
#pragma once

#include "articula/ros2/bridge/core/bridged_controller.hpp"
#include "articula/ros2/bridge/core/loop_watch.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace articula::ros2 {

/// Why joints are not those of a controller; empty if they are. Real-time: no (allocates).
[[nodiscard]] inline std::string foreign_joint(const BridgedController& controller,
                                               const std::vector<std::string>& joints) {
  for (const std::string& joint : joints) {
    const auto& own = controller.joints;
    if (std::find(own.begin(), own.end(), joint) != own.end()) continue;
    return "Incoming joint " + joint + " doesn't match the controller's joints.";
  }
  return {};
}

/// Why joints cannot reach a goal: a controller of efforts or velocities moves them to no position.
/// Empty if they can. Real-time: no (allocates).
/// @param joints  of the controller; empty: all of them
[[nodiscard]] inline std::string unfollowed_joint(const LoopWatch& watch,
                                                  const BridgedController& controller,
                                                  const std::vector<std::string>& joints) {
  for (std::size_t k = 0; k < controller.joints.size(); ++k) {
    const std::string& own = controller.joints[k];
    const bool is_named =
        joints.empty() || std::find(joints.begin(), joints.end(), own) != joints.end();
    if (!is_named || watch.follows(controller.indices[k])) continue;
    return "no active controller moves joint '" + own + "' to a position";
  }
  return {};
}

}  // namespace articula::ros2
