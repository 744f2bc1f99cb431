// SPDX-License-Identifier: Apache-2.0
/// @file Inverse dynamics: efforts from accelerations.
#pragma once

#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/newton_euler.hpp"

namespace articula {

/// The algorithm of inverse_dynamics.
struct InverseDynamics {
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(const Mechanism<N, B>& mechanism,
                                                           const Configuration<S, B>& configuration,
                                                           const JointArray<S, N>& v,
                                                           const JointArray<S, N>& a) noexcept {
    return newton_euler<S, N, B>(mechanism, configuration, v, a);
  }
};

/// The joint efforts for joint accelerations: effort = M(q) a + h(q, v), with Coriolis, centrifugal
/// and gravity efforts in h. Joint damping and friction are not included, see friction_effort.
/// Source: see newton_euler.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param v      joint velocities [rad/s or m/s], N x 1
/// @param a      joint accelerations [rad/s^2 or m/s^2], N x 1
/// @return       joint efforts [N m or N], N x 1; not finite only if an input is not finite, or at
///               overflow
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> inverse_dynamics(
    const R& robot, const JointVector<joint_count<R>>& q, const JointVector<joint_count<R>>& v,
    const JointVector<joint_count<R>>& a) noexcept {
  return detail::to_vector(detail::evaluate<InverseDynamics>(robot, q, v, a));
}

/// The same for several robots of one kind at once, see JointVectorPack. Real-time: yes.
template <Robot R, JointVectorPack<R> Q>
[[nodiscard]] Q inverse_dynamics(const R& robot, const Q& q, const std::type_identity_t<Q>& v,
                                 const std::type_identity_t<Q>& a) noexcept {
  return detail::evaluate_pack<InverseDynamics>(robot, q, v, a);
}

}  // namespace articula
