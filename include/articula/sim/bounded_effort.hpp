// SPDX-License-Identifier: Apache-2.0
/// @file Constraint efforts with bounds, as those of stops and dry friction.
#pragma once

#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/tree_factors.hpp"

namespace articula {

/// The bounds of each joint's constraint effort. The constraint holds the joint still by any effort
/// between them. A joint without constraint has both at 0.
template <int N>
struct EffortBounds {
  JointVector<N> lower = JointVector<N>::Zero();  ///< [N m or N], N x 1, <= upper, may be -infinity
  JointVector<N> upper = JointVector<N>::Zero();  ///< [N m or N], N x 1, may be infinity
};

/// The result of hold_within_bounds.
template <int N>
struct BoundedEffort {
  JointVector<N> motion = JointVector<N>::Zero();  ///< x, zero for the joints that are held, N x 1
  JointVector<N> effort = JointVector<N>::Zero();  ///< of each constraint, N x 1
  JointArray<bool, N> held{};                      ///< which joints are held still
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
/// @param parents      elimination tree of M
/// @param mass_matrix  M, N x N, positive definite
/// @param load         all other efforts (or momenta), N x 1
/// @param bounds       of the constraint efforts (or impulses)
/// Real-time: yes. O(N^3) per round, at most 16 N rounds.
template <int N>
[[nodiscard]] BoundedEffort<N> hold_within_bounds(const JointArray<int, N>& parents,
                                                  const JointMatrix<N>& mass_matrix,
                                                  const JointVector<N>& load,
                                                  const EffortBounds<N>& bounds) noexcept {
  BoundedEffort<N> answer;
  for (int j = 0; j < N; ++j) {
    answer.held[j] = bounds.lower[j] < bounds.upper[j];
  }
  constexpr int rounds = 16 * N;  // far more than measured; it only bounds the time
  for (int round = 0; round < rounds; ++round) {
    // Held joints leave the equations: identity rows and columns, zero right-hand side.
    JointRows<double, N> m = detail::to_rows(mass_matrix);
    JointArray<double, N> b;
    for (int j = 0; j < N; ++j) {
      b[j] = answer.held[j] ? 0 : load[j] + answer.effort[j];
      if (!answer.held[j]) continue;
      for (int i = 0; i < N; ++i) m[i][j] = m[j][i] = i == j ? 1 : 0;
    }
    const auto factors = factorise<double, N>(parents, m);
    answer.motion = detail::to_vector(solve<double, N>(parents, factors, b));
    const JointVector<N> taken = product<N>(mass_matrix, answer.motion);
    const auto needed = for_each_joint<N>([&](int j) noexcept { return taken[j] - load[j]; });
    int wrong = -1;
    for (int j = N - 1; j >= 0; --j) {
      if (answer.held[j]) {
        answer.motion[j] = 0;  // exactly, so that a held joint stays where it is to the last bit
        if (needed[j] < bounds.lower[j] || needed[j] > bounds.upper[j]) wrong = j;
      } else if (bounds.lower[j] < bounds.upper[j]) {
        const bool at_lower = answer.effort[j] == bounds.lower[j];
        if (at_lower ? answer.motion[j] < 0 : answer.motion[j] > 0) wrong = j;
      }
    }
    for (int j = 0; j < N; ++j) {
      if (answer.held[j] && j != wrong) answer.effort[j] = needed[j];
    }
    if (wrong < 0) break;
    bool& held = answer.held[wrong];
    if (held) {
      answer.effort[wrong] =
          needed[wrong] < bounds.lower[wrong] ? bounds.lower[wrong] : bounds.upper[wrong];
    }
    held = !held;
  }
  return answer;
}

}  // namespace articula
