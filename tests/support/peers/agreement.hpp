// SPDX-License-Identifier: Apache-2.0
/// @file Whether another library has the same equations of motion.
#pragma once

#include "catch.hpp"
#include "random.hpp"

#include <articula/dynamics/dynamics.hpp>

#include <Eigen/Dense>

namespace support {

/// How far results of another library may be off: of the size of the result or of 1, whichever is
/// larger; for accelerations times the condition of the mass matrix besides.
struct Tolerance {
  double effort;
  double acceleration;
};

/// Compares inverse dynamics, gravity, mass matrix and forward dynamics in random states. The
/// peer's forward dynamics are its mass matrix and bias efforts, solved by Eigen.
/// @param peer  has inverse_dynamics(q, v, a) and mass_matrix(q)
template <class R, class Peer>
void check_agreement(const R& robot, Peer& peer, int states, unsigned seed,
                     const Tolerance& tolerance) {
  CAPTURE(seed);
  constexpr int n = articula::joint_count<R>;
  using Vector = articula::JointVector<n>;
  Random random(seed);
  double effort_error = 0, acceleration_error = 0;
  const auto error = [](const auto& ours, const Eigen::MatrixXd& theirs) {
    return (Eigen::MatrixXd(ours) - theirs).norm() / (1 + theirs.norm());
  };
  const Vector zero = Vector::Zero();
  for (int k = 0; k < states; ++k) {
    const Vector q = random.vector<n>(3), v = random.vector<n>(3), a = random.vector<n>(10),
                 effort = random.vector<n>(20);
    const Eigen::MatrixXd mass = peer.mass_matrix(q);
    const Eigen::VectorXd bias = peer.inverse_dynamics(q, v, zero);
    for (const double e :
         {error(articula::inverse_dynamics(robot, q, v, a), peer.inverse_dynamics(q, v, a)),
          error(articula::gravity(robot, q), peer.inverse_dynamics(q, zero, zero)),
          error(articula::nonlinear_effects(robot, q, v), bias),
          error(articula::mass_matrix(robot, q), mass)}) {
      if (!(e <= effort_error)) effort_error = e;
    }
    const double e =
        error(articula::forward_dynamics(robot, q, v, effort), mass.llt().solve(effort - bias));
    if (!(e <= acceleration_error)) acceleration_error = e;
  }
  CHECK(effort_error <= tolerance.effort);
  CHECK(acceleration_error <= tolerance.acceleration);
}

}  // namespace support
