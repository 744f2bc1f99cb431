// SPDX-License-Identifier: Apache-2.0
/// @file Vectors and matrices whose size is the number of joints, known to the compiler.
#pragma once

#include <Eigen/Core>

namespace articula {

/// One real number per joint: a column vector of compile-time size. Unit as the user of it says.
/// @tparam N  number of joints (>= 1)
template <int N>
using JointVector = Eigen::Matrix<double, N, 1>;

/// One real number per pair of joints, such as the mass matrix: N x N, compile-time size.
/// @tparam N  number of joints (>= 1)
template <int N>
using JointMatrix = Eigen::Matrix<double, N, N>;

/// Joint vectors of K robots of one kind, a column each. A joint's numbers lie side by side in memory,
/// so that processors take several robots at once.
/// @tparam N  number of joints (>= 1)
/// @tparam K  number of robots (>= 2)
template <int N, int K>
using JointVectors = Eigen::Matrix<double, N, K, Eigen::RowMajor>;

}  // namespace articula
