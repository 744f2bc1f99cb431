// SPDX-License-Identifier: Apache-2.0
/// @file What the joints are asked to do.
#pragma once

#include "articula/core/joint_vector.hpp"

namespace articula {

/// What N joints are asked to do at one moment. Each controller's comment says which members it
/// uses.
/// @tparam N  number of joints
template <int N>
struct JointReference {
  static constexpr int joint_count = N;

  JointVector<N> position = JointVector<N>::Zero();      ///< q_ref [rad or m], N x 1
  JointVector<N> velocity = JointVector<N>::Zero();      ///< v_ref [rad/s or m/s], N x 1
  JointVector<N> acceleration = JointVector<N>::Zero();  ///< a_ref [rad/s^2 or m/s^2], N x 1
  JointVector<N> effort = JointVector<N>::Zero();        ///< feed-forward effort [N m or N], N x 1
};

}  // namespace articula
