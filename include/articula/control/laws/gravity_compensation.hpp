// SPDX-License-Identifier: Apache-2.0
/// @file The effort that carries the robot's weight.
#pragma once

#include "articula/core/control_input.hpp"
#include "articula/dynamics/gravity.hpp"
#include "articula/model/robot.hpp"

namespace articula {

/// Holds the robot against gravity at its measured position: effort = g(q). Alone it lets the robot
/// float.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class GravityCompensation {
  static_assert(detail::has_masses<R, GravityCompensation>);

 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr bool follows_position = false;

  GravityCompensation()
    requires DescribedRobot<R>
  = default;
  explicit GravityCompensation(const R& robot) : robot_(robot) {}

  /// g(q) [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<joint_count, S> output(
      const ControlInput<joint_count, S>& in) const noexcept {
    return gravity(robot_, in.state.position);
  }

 private:
  [[no_unique_address]] R robot_;
};

}  // namespace articula
