// SPDX-License-Identifier: Apache-2.0
/// @file Mimic joints: between the joints that are commanded and the bodies that move.
///
/// q_bodies = G q + offset, with one multiplier in each row of G. Velocities and accelerations go
/// by G, efforts come back by its transpose (equal power), the mass matrix is G^T M G. Without
/// mimic joints G is the identity and nothing is done.
#pragma once

#include "articula/model/mechanism.hpp"

#include <array>
#include <cstddef>

namespace articula {

/// N numbers of any scalar type, one per joint or body.
template <class S, int N>
using JointArray = std::array<S, static_cast<std::size_t>(N)>;

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
    for (std::size_t i = 0; i < rates.size(); ++i) {
      const Coupling& coupling = mechanism.couplings[i];
      rates[i] = S(coupling.multiplier) * v[static_cast<std::size_t>(coupling.joint)];
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
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] = positions[i] + S(mechanism.couplings[i].offset);
    }
  }
  return positions;
}

/// What the joints feel of efforts on the bodies, G^T effort.
template <class S, int N, int B>
[[nodiscard]] constexpr JointArray<S, N> joint_efforts(const Mechanism<N, B>& mechanism,
                                                       const JointArray<S, B>& effort) noexcept {
  if constexpr (N == B) {
    return effort;
  } else {
    JointArray<S, N> felt;
    felt.fill(S(0.0));
    for (std::size_t i = 0; i < effort.size(); ++i) {
      const Coupling& coupling = mechanism.couplings[i];
      S& joint = felt[static_cast<std::size_t>(coupling.joint)];
      joint = joint + S(coupling.multiplier) * effort[i];
    }
    return felt;
  }
}

/// The matrix that the joints see of one between the bodies, G^T M G.
template <class S, int N, int B>
[[nodiscard]] constexpr JointRows<S, N> joint_matrix(const Mechanism<N, B>& mechanism,
                                                     const JointRows<S, B>& matrix) noexcept {
  if constexpr (N == B) {
    return matrix;
  } else {
    JointRows<S, N> seen;
    for (auto& row : seen) row.fill(S(0.0));
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      const Coupling& coupling = mechanism.couplings[i];
      const JointArray<S, N> felt = joint_efforts<S, N, B>(mechanism, matrix[i]);
      JointArray<S, N>& row = seen[static_cast<std::size_t>(coupling.joint)];
      for (std::size_t j = 0; j < row.size(); ++j) {
        row[j] = row[j] + S(coupling.multiplier) * felt[j];
      }
    }
    return seen;
  }
}

/// For each joint the one before it on the way to the base, -1 if there is none: elements of the
/// mass matrix and of its factors between joints that are not on one such way are zero. Mimic
/// joints tie branches together, and so do rotors that two joints share: two joints are on one way
/// if one of them moves a body that carries a body of the other, if they share a rotor, or if both
/// are on that of a third joint further out. (This is the elimination tree of the mass matrix, the
/// last case being the fill-in of its factors. Source: [Liu 1990]; for joints [Featherstone 2008,
/// section 6.4].)
template <int N, int B>
[[nodiscard]] constexpr JointArray<int, N> branches(const Mechanism<N, B>& mechanism) noexcept {
  JointRows<bool, N> tied{};
  for (std::size_t i = 0; i < mechanism.bodies.size(); ++i) {
    const auto joint_of = [&](std::size_t body) {
      return N == B ? body : static_cast<std::size_t>(mechanism.couplings[body].joint);
    };
    const auto tie = [&](std::size_t other) {
      tied[joint_of(i)][joint_of(other)] = tied[joint_of(other)][joint_of(i)] = true;
    };
    for (int j = mechanism.bodies[i].parent; j >= 0;) {
      const auto carrier = static_cast<std::size_t>(j);
      tie(carrier);
      j = mechanism.bodies[carrier].parent;
    }
    const int other = mechanism.bodies[i].sharing_body;
    if (other >= 0) tie(static_cast<std::size_t>(other));
  }
  JointArray<int, N> parents;
  parents.fill(-1);
  for (std::size_t i = parents.size(); i-- > 0;) {
    for (std::size_t j = i; j-- > 0;) {
      if (!tied[i][j]) continue;
      if (parents[i] < 0) parents[i] = static_cast<int>(j);
      const auto parent = static_cast<std::size_t>(parents[i]);
      tied[parent][j] = tied[j][parent] = true;
    }
  }
  return parents;
}

}  // namespace articula
