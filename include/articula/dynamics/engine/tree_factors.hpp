// SPDX-License-Identifier: Apache-2.0
/// @file Factors of a mass matrix along the elimination tree, and the solution of equations by
/// them.
#pragma once

#include "articula/dynamics/engine/coupling.hpp"

namespace articula {

/// The factors of a symmetric matrix A = L^T D L whose elements between joints of different
/// branches are zero, as in a mass matrix. Elimination from the leaves to the base keeps those
/// zeros. Source: [Featherstone 2008, section 6.5].
template <class S, int N>
struct TreeFactors {
  JointRows<S, N> unit_lower;      ///< row k holds L left of the diagonal, for ancestors of k
  JointArray<S, N> inverse_pivot;  ///< 1 / D
};

/// Factorises a matrix.
/// @param parents  elimination tree of the matrix
/// @param matrix   symmetric, positive definite, by rows; only the lower triangle is read
/// Real-time: yes. O(N d^2) with d the depth of the tree.
template <class S, int N>
[[nodiscard]] constexpr TreeFactors<S, N> factorise(const JointArray<int, N>& parents,
                                                    JointRows<S, N> matrix) noexcept {
  TreeFactors<S, N> factors;
  for (int k = N; k-- > 0;) {
    factors.inverse_pivot[k] = S(1.0) / matrix[k][k];
    for (int i = parents[k]; i >= 0; i = parents[i]) {
      const S factor = matrix[k][i] * factors.inverse_pivot[k];
      for (int j = i; j >= 0; j = parents[j]) {
        matrix[i][j] = matrix[i][j] - factor * matrix[k][j];
      }
      matrix[k][i] = factor;
    }
  }
  factors.unit_lower = matrix;
  return factors;
}

/// Solves A x = b with the factors of A.
/// Real-time: yes. O(N d).
template <class S, int N>
[[nodiscard]] constexpr JointArray<S, N> solve(const JointArray<int, N>& parents,
                                               const TreeFactors<S, N>& factors,
                                               JointArray<S, N> b) noexcept {
  for (int k = N; k-- > 0;) {
    for (int i = parents[k]; i >= 0; i = parents[i]) {
      b[i] = b[i] - factors.unit_lower[k][i] * b[k];
    }
  }
  for (int k = 0; k < N; ++k) {
    b[k] = b[k] * factors.inverse_pivot[k];
    // From the root outwards: the most recent result comes last, so that the fewest operations
    // wait for it.
    JointArray<int, N> ancestors{};
    int count = 0;
    for (int i = parents[k]; i >= 0; i = parents[i]) ancestors[count++] = i;
    while (count-- > 0) {
      b[k] = b[k] - factors.unit_lower[k][ancestors[count]] * b[ancestors[count]];
    }
  }
  return b;
}

}  // namespace articula
