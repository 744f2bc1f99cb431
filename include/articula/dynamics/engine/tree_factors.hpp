// SPDX-License-Identifier: Apache-2.0
/// @file The factors of a matrix that has the shape of a robot's tree.
#pragma once

#include "articula/dynamics/engine/coupling.hpp"

namespace articula {

/// The factors of a symmetric matrix A = L^T D L whose elements between joints of different
/// branches are zero, as in a mass matrix. Eliminating from the leaves to the base keeps those
/// zeros. Source: [Featherstone 2008, section 6.5].
template <class S, int N>
struct TreeFactors {
  JointRows<S, N> unit_lower;      ///< row k holds L left of the diagonal, for ancestors of k
  JointArray<S, N> inverse_pivot;  ///< 1 / D
};

/// Factorises a matrix.
/// @param parents  of the tree that the matrix has, see branches
/// @param matrix   symmetric, positive definite, by rows; its lower triangle is used
/// Real-time: yes. O(N d^2) with d the depth of the tree.
template <class S, int N>
[[nodiscard]] constexpr TreeFactors<S, N> factorise(const JointArray<int, N>& parents,
                                                    JointRows<S, N> matrix) noexcept {
  TreeFactors<S, N> factors;
  for (std::size_t k = matrix.size(); k-- > 0;) {
    factors.inverse_pivot[k] = S(1.0) / matrix[k][k];
    for (int i = parents[k]; i >= 0;) {
      const auto row = static_cast<std::size_t>(i);
      const S factor = matrix[k][row] * factors.inverse_pivot[k];
      for (int j = i; j >= 0; j = parents[static_cast<std::size_t>(j)]) {
        const auto column = static_cast<std::size_t>(j);
        matrix[row][column] = matrix[row][column] - factor * matrix[k][column];
      }
      matrix[k][row] = factor;
      i = parents[row];
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
  for (std::size_t k = b.size(); k-- > 0;) {
    for (int i = parents[k]; i >= 0;) {
      const auto row = static_cast<std::size_t>(i);
      b[row] = b[row] - factors.unit_lower[k][row] * b[k];
      i = parents[row];
    }
  }
  for (std::size_t k = 0; k < b.size(); ++k) {
    b[k] = b[k] * factors.inverse_pivot[k];
    // From the root outwards: what has just been computed comes last, so that little waits for it.
    JointArray<std::size_t, N> rows{};
    std::size_t count = 0;
    for (int i = parents[k]; i >= 0; i = parents[rows[count++]]) {
      rows[count] = static_cast<std::size_t>(i);
    }
    while (count-- > 0) b[k] = b[k] - factors.unit_lower[k][rows[count]] * b[rows[count]];
  }
  return b;
}

}  // namespace articula
