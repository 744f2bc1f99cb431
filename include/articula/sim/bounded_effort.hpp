// SPDX-License-Identifier: Apache-2.0
/// @file Constraint efforts with bounds, as those of stops and dry friction.
#pragma once

#include "articula/core/scalar.hpp"
#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/tree_factors.hpp"

#include <type_traits>

namespace articula {

/// The bounds of each joint's constraint effort. The constraint holds the joint still by any effort
/// between them. A joint without constraint has both at 0.
template <int N, class S = double>
struct EffortBounds {
  JointVector<N, S> lower = JointVector<N, S>::Zero();  ///< [N m or N], N x 1, may be -infinity
  JointVector<N, S> upper = JointVector<N, S>::Zero();  ///< [N m or N], N x 1, may be infinity

  /// Whether there is a constraint on a joint. Real-time: yes.
  [[nodiscard]] MaskOf<S> binds(int joint) const noexcept { return lower[joint] < upper[joint]; }
};

/// The result of hold_within_bounds.
template <int N, class S = double>
struct BoundedEffort {
  JointVector<N, S> motion = JointVector<N, S>::Zero();  ///< x, zero for the joints that are held
  JointVector<N, S> effort = JointVector<N, S>::Zero();  ///< of each constraint, N x 1
  JointArray<MaskOf<S>, N> held{};                       ///< which joints are held still
};

/// Solves for constraint efforts within bounds that hold joints still as far as they can:
///
///     M x = load + effort,   lower <= effort <= upper,
///     x_j = 0 where effort_j lies between its bounds, x_j >= 0 at the lower, x_j <= 0 at the
///     upper.
///
/// With x an acceleration this is dry friction and contact with a stop. With x a velocity and
/// load = M v it is an inelastic impact. For positive definite M there is exactly one solution. The
/// method is principal pivoting: the first joint that violates a condition changes sides, until
/// none does [Murty 1974]. It usually takes a few rounds.
/// @tparam S           double, or a pack: each robot changes sides as it would alone, and takes
///                     part in the rounds of the slowest without a change
/// @param parents      elimination tree of M
/// @param mass_matrix  M, N x N, positive definite
/// @param load         all other efforts (or momenta), N x 1
/// @param bounds       of the constraint efforts (or impulses)
/// Real-time: yes. O(N^3) per round, at most 16 N rounds.
template <int N, class S>
[[nodiscard]] BoundedEffort<N, S> hold_within_bounds(
    const JointArray<int, N>& parents, const JointMatrix<N, S>& mass_matrix,
    const std::type_identity_t<JointVector<N, S>>& load,
    const std::type_identity_t<EffortBounds<N, S>>& bounds) noexcept {
  using Mask = MaskOf<S>;
  BoundedEffort<N, S> answer;
  for (int j = 0; j < N; ++j) answer.held[j] = bounds.binds(j);
  constexpr int rounds = 16 * N;  // far more than measured; it only bounds the time
  for (int round = 0; round < rounds; ++round) {
    // Held joints leave the equations: identity rows and columns, zero right-hand side.
    JointRows<S, N> m = detail::to_rows(mass_matrix);
    JointArray<S, N> b;
    for (int j = 0; j < N; ++j) {
      const Mask& held = answer.held[j];
      b[j] = select(held, S(0), S(load[j] + answer.effort[j]));
      if (!any_of(held)) continue;
      for (int i = 0; i < N; ++i) {
        m[i][j] = m[j][i] = select(held, S(i == j ? 1 : 0), m[i][j]);
      }
    }
    const auto factors = factorise<S, N>(parents, m);
    answer.motion = detail::to_vector(solve<S, N>(parents, factors, b));
    const JointVector<N, S> taken = product<N>(mass_matrix, answer.motion);
    const auto needed = for_each_joint<N, S>([&](int j) noexcept { return S(taken[j] - load[j]); });
    // The first joint that violates a condition is wrong.
    Mask any_wrong = mask_of<S>(false);
    JointArray<Mask, N> wrong;
    for (int j = 0; j < N; ++j) {
      const Mask &held = answer.held[j], binds = bounds.binds(j);
      const S &x = answer.motion[j], lower = bounds.lower[j], upper = bounds.upper[j];
      const Mask below = needed[j]<lower, above = needed[j]> upper, too_weak = below | above;
      const Mask at_lower = answer.effort[j] == lower;
      const Mask turns = (at_lower & (x < 0)) | (not_of(at_lower) & (x > 0));
      const Mask violates = (held & too_weak) | (not_of(held) & binds & turns);
      wrong[j] = violates & not_of(any_wrong);
      any_wrong = any_wrong | violates;
      answer.motion[j] = select(held, S(0), x);  // exactly: a held joint stays to the last bit
    }
    for (int j = 0; j < N; ++j) {
      const S bound = select(needed[j] < bounds.lower[j], bounds.lower[j], bounds.upper[j]);
      const S effort = select(wrong[j], bound, needed[j]);
      answer.effort[j] = select(answer.held[j], effort, answer.effort[j]);
      answer.held[j] = answer.held[j] ^ wrong[j];
    }
    if (!any_of(any_wrong)) break;
  }
  return answer;
}

}  // namespace articula
