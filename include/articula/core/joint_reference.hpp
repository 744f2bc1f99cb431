// SPDX-License-Identifier: Apache-2.0
/// @file The motion and effort that a controller is to track.
#pragma once

#include "articula/core/joint_vector.hpp"

namespace articula {

/// What N joints are to do at one moment. Each controller's comment lists the members that it uses.
/// @tparam N       number of joints
/// @tparam Scalar  type of a number: double, or a pack with the numbers of several robots
template <int N, class Scalar = double>
struct JointReference {
  static constexpr int joint_count = N;
  using Vector = JointVector<N, Scalar>;

  Vector position = Vector::Zero();      ///< q_ref [rad or m], N x 1
  Vector velocity = Vector::Zero();      ///< v_ref [rad/s or m/s], N x 1
  Vector acceleration = Vector::Zero();  ///< a_ref [rad/s^2 or m/s^2], N x 1
  Vector effort = Vector::Zero();        ///< feed-forward effort [N m or N], N x 1
};

}  // namespace articula
