// SPDX-License-Identifier: Apache-2.0
/// @file The range of commands that a robot's description allows.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/scalar.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <limits>

namespace articula::detail {

/// The lowest and highest values of each joint.
template <int N>
struct CommandRange {
  JointArray<double, N> lowest{}, highest{};

  /// The nearest value in the range of a joint. A NaN stays one. Real-time: yes.
  template <class S>
  [[nodiscard]] S clamp(const S& value, int joint) const noexcept {
    return articula::clamp(value, lowest[joint], highest[joint]);
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
    double highest = limits.upper, lowest = limits.lower;
    if constexpr (requires(Command command) { command.effort; }) {
      lowest = -(highest = limits.effort);
    } else if constexpr (requires(Command command) { command.velocity; }) {
      lowest = -(highest = limits.velocity);
    }
    range.lowest[j] = std::max(lowest, -largest);
    range.highest[j] = std::min(highest, largest);
  }
  return range;
}

}  // namespace articula::detail
