// SPDX-License-Identifier: Apache-2.0
/// @file The effort that overcomes joint damping and friction.
#pragma once

#include "articula/core/control_input.hpp"
#include "articula/dynamics/friction_effort.hpp"

namespace articula {

/// Cancels the joints' own damping and Coulomb friction at the measured velocity: effort = D v + f
/// sign(v). Source: [Siciliano et al. 2009, equation 8.56], where it is part of n(q, v).
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class FrictionCompensation {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr bool follows_position = false;

  FrictionCompensation()
    requires DescribedRobot<R>
  = default;
  explicit FrictionCompensation(const R& robot) : robot_(robot) {}

  /// D v + f sign(v) [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<joint_count, S> output(
      const ControlInput<joint_count, S>& in) const noexcept {
    return -friction_effort(robot_, in.state.velocity);
  }

 private:
  [[no_unique_address]] R robot_;
};

}  // namespace articula
