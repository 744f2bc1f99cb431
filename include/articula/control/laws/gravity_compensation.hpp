// SPDX-License-Identifier: Apache-2.0
/// @file The effort that carries the robot's weight.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/dynamics/gravity.hpp"
#include "articula/model/dynamic_robot.hpp"

namespace articula {

/// Holds the robot against gravity at its measured position: effort = g(q). Alone it lets the robot
/// float.
/// @tparam R  the robot
template <Robot R>
class GravityCompensation {
  static_assert(detail::has_masses<R, GravityCompensation>);

 public:
  static constexpr int joint_count = articula::joint_count<R>;

  GravityCompensation()
    requires DescribedRobot<R>
  = default;
  explicit GravityCompensation(const R& robot) : robot_(robot) {}

  /// Nothing to forget. Real-time: yes.
  void start(const JointState<joint_count>&) noexcept {}

  /// g(q) [N m or N], N x 1. Real-time: yes.
  [[nodiscard]] JointVector<joint_count> effort(const JointState<joint_count>& state,
                                                const JointReference<joint_count>&,
                                                double) const noexcept {
    return gravity(robot_, state.position);
  }

 private:
  [[no_unique_address]] R robot_;
};

}  // namespace articula
