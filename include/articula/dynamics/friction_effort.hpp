// SPDX-License-Identifier: Apache-2.0
/// @file The efforts of joint damping and friction.
#pragma once

#include "articula/core/scalar.hpp"
#include "articula/dynamics/engine/evaluate.hpp"

namespace articula {

namespace detail {

template <class S, Robot R>
[[nodiscard]] JointVector<joint_count<R>, S> friction_effort(
    const R& robot, const JointVector<joint_count<R>, S>& v) noexcept {
  return for_each_joint<joint_count<R>, S>([&](int j) noexcept {
    const JointProperties& joint = model_of(robot).joints[j];
    const S sign = select(v[j] > 0, S(1), select(v[j] < 0, S(-1), S(0)));
    return -(joint.damping * v[j] + joint.friction * sign);
  });
}

}  // namespace detail

/// The efforts that damping and Coulomb friction exert on moving joints, against their velocity.
/// effort_j = -(damping_j v_j + friction_j sign(v_j)), with sign(0) = 0. The friction that holds a
/// joint at rest depends on the other efforts; the simulator computes it.
/// @param robot  a described robot or a model
/// @param v      joint velocities [rad/s or m/s], N x 1
/// @return       efforts [N m or N], N x 1, opposite in sign to v
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> friction_effort(
    const R& robot, const JointVector<joint_count<R>>& v) noexcept {
  return detail::friction_effort<double>(robot, v);
}

/// The same for the robots of a pack.
/// Real-time: yes.
template <Robot R, JointVectorPack<R> Q>
  requires(Q::ColsAtCompileTime == 1)
[[nodiscard]] Q friction_effort(const R& robot, const Q& v) noexcept {
  return detail::friction_effort<typename Q::Scalar>(robot, v);
}

}  // namespace articula
