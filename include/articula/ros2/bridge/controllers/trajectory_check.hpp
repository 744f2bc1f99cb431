// SPDX-License-Identifier: Apache-2.0
/// @file The check of joints before a loop is asked to move them to positions.
#pragma once

#include "articula/ros2/bridge/core/bridged_controller.hpp"
#include "articula/ros2/bridge/core/loop_watch.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace articula::ros2 {

/// Why a controller cannot move joints to positions: they are not its own, or it follows efforts or
/// velocities alone. Empty if it can. Real-time: no (allocates).
/// @param joints  empty: all joints of the controller
[[nodiscard]] inline std::string refusal_of_motion(const LoopWatch& watch,
                                                   const BridgedController& controller,
                                                   const std::vector<std::string>& joints) {
  const auto contains = [](const std::vector<std::string>& all, const std::string& joint) {
    return std::find(all.begin(), all.end(), joint) != all.end();
  };
  for (const std::string& joint : joints) {
    if (contains(controller.joints, joint)) continue;
    return "Incoming joint " + joint + " doesn't match the controller's joints.";
  }
  for (std::size_t k = 0; k < controller.joints.size(); ++k) {
    const std::string& own = controller.joints[k];
    if (watch.follows(controller.indices[k])) continue;
    if (joints.empty() || contains(joints, own))
      return "no active controller moves joint '" + own + "' to a position";
  }
  return {};
}

}  // namespace articula::ros2
