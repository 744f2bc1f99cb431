// SPDX-License-Identifier: Apache-2.0
/// @file What is measured at the joints.
#pragma once

#include "articula/core/joint_vector.hpp"

namespace articula {

/// What is measured at N joints at one moment. Prismatic joints have m, m/s and N.
/// @tparam N  number of joints
template <int N>
struct JointState {
  static constexpr int joint_count = N;

  JointVector<N> position = JointVector<N>::Zero();  ///< q [rad or m], N x 1
  JointVector<N> velocity = JointVector<N>::Zero();  ///< v [rad/s or m/s], N x 1
  JointVector<N> effort =
      JointVector<N>::Zero();  ///< effort applied by the drives [N m or N], N x 1
};

}  // namespace articula
