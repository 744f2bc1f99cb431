// SPDX-License-Identifier: Apache-2.0
/// @file The range of commands that a robot's description allows.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <limits>

namespace articula::detail {

/// The lowest and highest values of each joint, N x 1.
template <int N>
struct CommandRange {
  JointVector<N> lowest, highest;
};

/// The efforts, velocities or positions that a robot's joints can be asked for. Real-time: yes.
template <class Command, Robot R>
[[nodiscard]] CommandRange<joint_count<R>> command_range(const R& robot) noexcept {
  constexpr int n = joint_count<R>;
  const auto limits = [&](double JointLimits::* limit) {
    return joint_values(robot, [&](const JointProperties& joint) { return joint.limits.*limit; });
  };
  if constexpr (std::same_as<Command, PositionCommand<n>>) {
    return {limits(&JointLimits::lower), limits(&JointLimits::upper)};
  } else {
    constexpr bool is_effort = requires(Command command) { command.effort; };
    const JointVector<n> highest =
        limits(is_effort ? &JointLimits::effort : &JointLimits::velocity);
    return {-highest, highest};
  }
}

/// The same range, where no limit is a finite number.
/// @param largest  in place of infinity
template <class Command, Robot R>
[[nodiscard]] CommandRange<joint_count<R>> finite_range(const R& robot, double largest) noexcept {
  const CommandRange<joint_count<R>> range = command_range<Command>(robot);
  return {range.lowest.cwiseMax(-largest), range.highest.cwiseMin(largest)};
}

/// The range that a controller keeps. A sum that overflows is limited to the largest number where
/// the joint has no limit.
template <class Command, Robot R>
class KeptRange {
 public:
  explicit KeptRange(const R& robot)
      : range_(finite_range<Command>(robot, std::numeric_limits<double>::max())) {}
  [[nodiscard]] const CommandRange<joint_count<R>>& operator()() const noexcept { return range_; }

 private:
  CommandRange<joint_count<R>> range_;
};

/// The range of a described robot takes no memory: it is a constant of the compiler.
template <class Command, DescribedRobot R>
class KeptRange<Command, R> {
 public:
  explicit KeptRange(const R&) {}
  [[nodiscard]] CommandRange<joint_count<R>> operator()() const noexcept {
    return finite_range<Command>(R(), std::numeric_limits<double>::max());
  }
};

}  // namespace articula::detail
