// SPDX-License-Identifier: Apache-2.0
/// @file The efforts due to velocity and gravity.
#pragma once

#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/newton_euler.hpp"

namespace articula {

/// The algorithm of nonlinear_effects.
struct NonlinearEffects {
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(const Mechanism<N, B>& mechanism,
                                                           const Configuration<S, B>& configuration,
                                                           const JointArray<S, N>& v) noexcept {
    JointArray<S, N> no_acceleration;
    no_acceleration.fill(S(0.0));
    return newton_euler<S, N, B>(mechanism, configuration, v, no_acceleration);
  }
};

/// Coriolis, centrifugal and gravity efforts: h(q, v), the inverse dynamics at a = 0.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param v      joint velocities [rad/s or m/s], N x 1
/// @return       joint efforts [N m or N], N x 1
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> nonlinear_effects(
    const R& robot, const JointVector<joint_count<R>>& q,
    const JointVector<joint_count<R>>& v) noexcept {
  return detail::to_vector(detail::evaluate<NonlinearEffects>(robot, q, v));
}

/// The same for several robots of one kind at once, see JointVectorPack. Real-time: yes.
template <Robot R, JointVectorPack<R> Q>
[[nodiscard]] Q nonlinear_effects(const R& robot, const Q& q,
                                  const std::type_identity_t<Q>& v) noexcept {
  return detail::evaluate_pack<NonlinearEffects>(robot, q, v);
}

}  // namespace articula
