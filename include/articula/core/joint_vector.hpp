// SPDX-License-Identifier: Apache-2.0
/// @file Vectors and matrices whose size is the number of joints, known to the compiler.
#pragma once

#include <Eigen/Core>

#include <utility>

namespace articula {

/// One number per joint: a column vector of compile-time size. The owner states the unit.
/// @tparam N       number of joints (>= 1)
/// @tparam Scalar  type of a number: double, or a pack with the numbers of several robots
template <int N, class Scalar = double>
using JointVector = Eigen::Matrix<Scalar, N, 1>;

/// One number per pair of joints, such as the mass matrix: N x N, compile-time size.
/// @tparam N       number of joints (>= 1)
/// @tparam Scalar  as that of JointVector
template <int N, class Scalar = double>
using JointMatrix = Eigen::Matrix<Scalar, N, N>;

/// Joint vectors of K robots of one kind, one in each column. The numbers of one joint are adjacent
/// in memory, so that processors compute several robots at once.
/// @tparam N  number of joints (>= 1)
/// @tparam K  number of robots (>= 2)
template <int N, int K>
using JointVectors = Eigen::Matrix<double, N, K, Eigen::RowMajor>;

/// The vector with the number f(j) for each joint j. It replaces Eigen's expressions, which take
/// longer to compile because each is a type of its own.
/// @tparam N       number of joints
/// @tparam Scalar  type of a number
/// @param f        callable with an int -> Scalar
/// Real-time: yes if f is. O(N).
template <int N, class Scalar = double, class Function>
[[nodiscard, gnu::always_inline]] inline JointVector<N, Scalar> for_each_joint(
    const Function& f) noexcept {
  JointVector<N, Scalar> vector;
  // A fold and not a loop: compilers leave vectors in memory that are filled by loops.
  [&]<int... J>(std::integer_sequence<int, J...>) __attribute__((always_inline)) {
    ((vector.coeffRef(J) = f(J)), ...);
  }(std::make_integer_sequence<int, N>{});
  return vector;
}

/// A x. Real-time: yes. O(N^2).
template <int N, class Scalar>
[[nodiscard]] JointVector<N, Scalar> product(const JointMatrix<N, Scalar>& a,
                                             const JointVector<N, Scalar>& x) noexcept {
  return for_each_joint<N, Scalar>([&](int i) noexcept {
    Scalar sum(0.0);
    for (int j = 0; j < N; ++j) sum += a(i, j) * x[j];
    return sum;
  });
}

}  // namespace articula
