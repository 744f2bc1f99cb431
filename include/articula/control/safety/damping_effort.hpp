// SPDX-License-Identifier: Apache-2.0
/// @file The effort that brings a robot to rest.
#pragma once

#include "articula/dynamics/gravity.hpp"
#include "articula/dynamics/mass_matrix.hpp"

namespace articula {

/// The effort that carries a robot against gravity and lets its motion decay:
///
///     effort = g(q) - M(q) v / T.
///
/// Up to Coriolis effects v falls as exp(-t/T) in all joints at once, whatever their inertias, so
/// that one number serves every robot.
/// @param robot     whose joints these are
/// @param position  q [rad or m], N x 1
/// @param velocity  v [rad/s or m/s], N x 1
/// @param time      T [s], > 0
/// @return          [N m or N], N x 1, not limited; of packs for each robot
/// Real-time: yes.
template <Robot R, class S>
[[nodiscard]] JointVector<joint_count<R>, S> damping_effort(
    const R& robot, const JointVector<joint_count<R>, S>& position,
    const JointVector<joint_count<R>, S>& velocity, double time) noexcept {
  return gravity(robot, position) - product(mass_matrix(robot, position), velocity) / S(time);
}

}  // namespace articula
