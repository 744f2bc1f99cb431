// SPDX-License-Identifier: Apache-2.0
/// @file Forward dynamics: accelerations from efforts.
#pragma once

#include "articula/dynamics/articulated_bodies.hpp"
#include "articula/dynamics/engine/tree_factors.hpp"
#include "articula/dynamics/mass_matrix.hpp"
#include "articula/dynamics/nonlinear_effects.hpp"

namespace articula {

/// The algorithm of forward_dynamics: the mass matrix, factorised along the tree, and the bias
/// efforts. Source: [Featherstone 2008, section 6.1].
struct ForwardDynamics {
  using Alternative = ArticulatedBodies;

  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(
      const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration,
      const JointArray<S, N>& v, const JointArray<S, N>& effort) noexcept {
    // The bias first: it leaves fewer numbers than the matrix to keep in registers.
    JointArray<S, N> b = NonlinearEffects::evaluate<S, N, B>(mechanism, configuration, v);
    for (int i = 0; i < N; ++i) b[i] = effort[i] - b[i];
    const auto matrix = MassMatrix::evaluate<S, N, B>(mechanism, configuration);
    const JointArray<int, N> parents = elimination_tree(mechanism);
    return solve<S, N>(parents, factorise<S, N>(parents, matrix), b);
  }
};

/// The joint accelerations for joint efforts: a = M(q)^-1 (effort - h(q, v)). It inverts
/// inverse_dynamics in the last argument. Joint damping and friction are not included.
/// @param robot   a described robot or a model
/// @param q       joint positions [rad or m], N x 1
/// @param v       joint velocities [rad/s or m/s], N x 1
/// @param effort  joint efforts [N m or N], N x 1
/// @return        joint accelerations [rad/s^2 or m/s^2], N x 1. They are meaningless, and may not
///                be finite, if M(q) is singular. A described robot whose M(q) is always singular,
///                because a joint has no inertia, does not compile
/// Real-time: yes. O(N d^2) with d the depth of the tree, O(N) where that takes less time.
template <Robot R>
[[nodiscard]] inline JointVector<joint_count<R>> forward_dynamics(
    const R& robot, const JointVector<joint_count<R>>& q, const JointVector<joint_count<R>>& v,
    const JointVector<joint_count<R>>& effort) noexcept {
  return detail::to_vector(detail::evaluate<ForwardDynamics>(robot, q, v, effort));
}

/// The same for several robots of one kind at once, see JointVectorPack. Real-time: yes.
template <Robot R, JointVectorPack<R> Q>
[[nodiscard]] Q forward_dynamics(const R& robot, const Q& q, const std::type_identity_t<Q>& v,
                                 const std::type_identity_t<Q>& effort) noexcept {
  return detail::evaluate_pack<ForwardDynamics>(robot, q, v, effort);
}

}  // namespace articula
