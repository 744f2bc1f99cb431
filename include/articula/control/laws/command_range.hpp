// SPDX-License-Identifier: Apache-2.0
/// @file The range of commands that a robot's description allows.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <concepts>
#include <limits>

namespace articula::detail {

/// The lowest and highest values of each joint.
template <int N>
struct CommandRange {
  JointArray<double, N> lowest{}, highest{};

  /// The nearest value in the range of a joint. A NaN stays one. Real-time: yes.
  [[nodiscard]] double clamp(double value, int joint) const noexcept {
    return std::clamp(value, lowest[joint], highest[joint]);
  }
};

/// The efforts, velocities or positions that a robot's joints can be asked for.
/// @param largest  in place of an infinite limit
/// Real-time: yes.
template <class Command, Robot R>
[[nodiscard]] constexpr CommandRange<joint_count<R>> command_range(
    const R& robot, double largest = std::numeric_limits<double>::infinity()) noexcept {
  CommandRange<joint_count<R>> range;
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointLimits& limits = model_of(robot).joints[j].limits;
    double lowest = limits.lower, highest = limits.upper;
    if constexpr (!std::same_as<Command, PositionCommand<joint_count<R>>>) {
      highest = requires(Command command) { command.effort; } ? limits.effort : limits.velocity;
      lowest = -highest;
    }
    range.lowest[j] = std::max(lowest, -largest);
    range.highest[j] = std::min(highest, largest);
  }
  return range;
}

}  // namespace articula::detail
