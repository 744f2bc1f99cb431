// SPDX-License-Identifier: Apache-2.0
/// @file The measured state of the joints.
#pragma once

#include "articula/core/joint_vector.hpp"

namespace articula {

/// What is measured at N joints at one moment. Prismatic joints have m, m/s and N.
/// @tparam N       number of joints
/// @tparam Scalar  type of a number: double, or a pack with the numbers of several robots
template <int N, class Scalar = double>
struct JointState {
  static constexpr int joint_count = N;
  using Vector = JointVector<N, Scalar>;

  Vector position = Vector::Zero();  ///< q [rad or m], N x 1
  Vector velocity = Vector::Zero();  ///< v [rad/s or m/s], N x 1
  Vector effort = Vector::Zero();    ///< effort applied by the drives [N m or N], N x 1
};

}  // namespace articula
