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

  /// The nearest values in the range, N x 1. A NaN stays one. Real-time: yes.
  [[nodiscard]] JointVector<N> clamp(const JointVector<N>& values) const noexcept {
    return for_each_joint<N>(
        [&](int j) { return std::min(std::max(values[j], lowest[j]), highest[j]); });
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

/// The range that a controller keeps. A sum that overflows is limited to the largest number where
/// the joint has no limit.
template <class Command, Robot R>
class KeptRange {
 public:
  explicit KeptRange(const R& robot)
      : range_(command_range<Command>(robot, std::numeric_limits<double>::max())) {}
  [[nodiscard]] const CommandRange<joint_count<R>>& operator()() const noexcept { return range_; }

 private:
  CommandRange<joint_count<R>> range_;
};

/// That of a described robot takes no memory: it is a constant of the compiler.
template <class Command, DescribedRobot R>
class KeptRange<Command, R> {
 public:
  explicit KeptRange(const R&) {}
  [[nodiscard]] const CommandRange<joint_count<R>>& operator()() const noexcept { return range; }

 private:
  static constexpr CommandRange<joint_count<R>> range =
      command_range<Command>(R(), std::numeric_limits<double>::max());
};

}  // namespace articula::detail
