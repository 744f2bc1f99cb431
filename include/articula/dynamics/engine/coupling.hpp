// SPDX-License-Identifier: Apache-2.0
/// @file Mimic joints: the map between the commanded joints and the moving bodies.
///
/// q_bodies = G q + offset, with one multiplier in each row of G. Velocities and accelerations map
/// by G, efforts by its transpose (equal power), the mass matrix by G^T M G. Without mimic joints G
/// is the identity, and these functions return their argument.
#pragma once

#include "articula/model/mechanism.hpp"

namespace articula {

/// N x N numbers by rows.
template <class S, int N>
using JointRows = JointArray<JointArray<S, N>, N>;

/// Velocities or accelerations of the bodies' joints, G v.
template <class S, int N, int B>
[[nodiscard]] constexpr JointArray<S, B> body_rates(const Mechanism<N, B>& mechanism,
                                                    const JointArray<S, N>& v) noexcept {
  if constexpr (N == B) {
    return v;
  } else {
    JointArray<S, B> rates;
    for (int i = 0; i < B; ++i) {
      const Coupling& coupling = mechanism.couplings[i];
      rates[i] = S(coupling.multiplier) * v[coupling.joint];
    }
    return rates;
  }
}

/// Positions of the bodies' joints, G q + offset.
template <class S, int N, int B>
[[nodiscard]] constexpr JointArray<S, B> body_positions(const Mechanism<N, B>& mechanism,
                                                        const JointArray<S, N>& q) noexcept {
  JointArray<S, B> positions = body_rates<S, N, B>(mechanism, q);
  if constexpr (N != B) {
    for (int i = 0; i < B; ++i) positions[i] = positions[i] + S(mechanism.couplings[i].offset);
  }
  return positions;
}

/// The joint efforts that are equivalent to efforts on the bodies, G^T effort.
template <class S, int N, int B>
[[nodiscard]] constexpr JointArray<S, N> joint_efforts(const Mechanism<N, B>& mechanism,
                                                       const JointArray<S, B>& effort) noexcept {
  if constexpr (N == B) {
    return effort;
  } else {
    JointArray<S, N> sum;
    sum.fill(S(0.0));
    for (int i = 0; i < B; ++i) {
      const Coupling& coupling = mechanism.couplings[i];
      sum[coupling.joint] = sum[coupling.joint] + S(coupling.multiplier) * effort[i];
    }
    return sum;
  }
}

/// The matrix between the joints for one between the bodies, G^T M G.
template <class S, int N, int B>
[[nodiscard]] constexpr JointRows<S, N> joint_matrix(const Mechanism<N, B>& mechanism,
                                                     const JointRows<S, B>& matrix) noexcept {
  if constexpr (N == B) {
    return matrix;
  } else {
    JointRows<S, N> sum;
    for (auto& row : sum) row.fill(S(0.0));
    for (int i = 0; i < B; ++i) {
      const Coupling& coupling = mechanism.couplings[i];
      const JointArray<S, N> efforts = joint_efforts<S, N, B>(mechanism, matrix[i]);
      JointArray<S, N>& row = sum[coupling.joint];
      for (int j = 0; j < N; ++j) row[j] = row[j] + S(coupling.multiplier) * efforts[j];
    }
    return sum;
  }
}

/// The elimination tree of the mass matrix: for each joint its parent, -1 if there is none.
/// Elements of the mass matrix and of its factors are zero unless one joint is an ancestor of the
/// other. Joint i is an ancestor of joint j if one of them moves a body that carries a body of the
/// other. It also is if they share a rotor, or if both are ancestors of a joint further out
/// (fill-in of the factors). Mimic joints and shared rotors so join branches.
/// Source: [Liu 1990]; for joints [Featherstone 2008, section 6.4].
template <int N, int B>
[[nodiscard]] constexpr JointArray<int, N> elimination_tree(
    const Mechanism<N, B>& mechanism) noexcept {
  const auto joint_of = [&](int body) { return N == B ? body : mechanism.couplings[body].joint; };
  JointRows<bool, N> tied{};
  for (int i = 0; i < B; ++i) {
    const auto tie = [&](int other) {
      tied[joint_of(i)][joint_of(other)] = tied[joint_of(other)][joint_of(i)] = true;
    };
    const Body& body = mechanism.bodies[i];
    for (int j = body.parent; j >= 0; j = mechanism.bodies[j].parent) tie(j);
    if (body.sharing_body >= 0) tie(body.sharing_body);
  }
  JointArray<int, N> parents;
  parents.fill(-1);
  for (int i = N; i-- > 0;) {
    for (int j = i; j-- > 0;) {
      if (!tied[i][j]) continue;
      if (parents[i] < 0) parents[i] = j;
      tied[parents[i]][j] = tied[j][parents[i]] = true;
    }
  }
  return parents;
}

}  // namespace articula
