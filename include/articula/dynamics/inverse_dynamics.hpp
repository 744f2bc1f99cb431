// SPDX-License-Identifier: Apache-2.0
/// @file Inverse dynamics: from motion to effort.
#pragma once

#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/newton_euler.hpp"

namespace articula {

/// The algorithm behind inverse_dynamics.
struct InverseDynamics {
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(const Mechanism<N, B>& mechanism,
                                                           const Configuration<S, B>& configuration,
                                                           const JointArray<S, N>& v,
                                                           const JointArray<S, N>& a) noexcept {
    return newton_euler<S, N, B>(mechanism, configuration, v, a);
  }
};

/// The joint efforts that make the rigid bodies move as given.
/// effort = M(q) a + h(q, v), where h holds Coriolis, centrifugal and gravity efforts. Joint
/// damping and friction are not in it (see friction_effort).   Source: see newton_euler.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param v      joint velocities [rad/s or m/s], N x 1
/// @param a      joint accelerations [rad/s^2 or m/s^2], N x 1
/// @return       joint efforts [N m or N], N x 1; not finite only if an input is not, or overflows
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> inverse_dynamics(
    const R& robot, const JointVector<joint_count<R>>& q, const JointVector<joint_count<R>>& v,
    const JointVector<joint_count<R>>& a) noexcept {
  return detail::to_vector(detail::evaluate<InverseDynamics>(robot, q, v, a));
}

/// The same for several robots of one kind at once: much faster than one by one, as many at a time
/// as the registers of the target processor have lanes (-march=native). Real-time: yes.
template <Robot R, JointVectorPack<R> Q>
[[nodiscard]] Q inverse_dynamics(const R& robot, const Q& q, const std::type_identity_t<Q>& v,
                                 const std::type_identity_t<Q>& a) noexcept {
  return detail::evaluate_pack<InverseDynamics>(robot, q, v, a);
}

}  // namespace articula
