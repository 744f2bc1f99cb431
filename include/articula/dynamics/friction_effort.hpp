// SPDX-License-Identifier: Apache-2.0
/// @file The efforts of joint damping and friction.
#pragma once

#include "articula/core/joint_vector.hpp"
#include "articula/model/robot.hpp"

namespace articula {

/// The efforts that damping and Coulomb friction exert on moving joints, against their velocity:
/// effort_j = -(damping_j v_j + friction_j sign(v_j)), with sign(0) = 0. What holds a joint at rest
/// by friction depends on the other efforts; the simulator finds it.
/// @param robot  a described robot or a model
/// @param v      joint velocities [rad/s or m/s], N x 1
/// @return       efforts [N m or N], N x 1, opposite in sign to v
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> friction_effort(
    const R& robot, const JointVector<joint_count<R>>& v) noexcept {
  JointVector<joint_count<R>> effort;
  for (int i = 0; i < joint_count<R>; ++i) {
    const JointProperties& joint = model_of(robot).joints[i];
    const double sign = v[i] > 0 ? 1 : v[i] < 0 ? -1 : 0;
    effort[i] = -(joint.damping * v[i] + joint.friction * sign);
  }
  return effort;
}

}  // namespace articula
