// SPDX-License-Identifier: Apache-2.0
/// @file The classical fourth-order Runge-Kutta method for equations of motion.
#pragma once

#include "articula/core/joint_vector.hpp"

namespace articula {

/// Position and velocity of N joints: the state of the equations of motion.
template <int N>
struct Motion {
  JointVector<N> position = JointVector<N>::Zero();  ///< q [rad or m], N x 1
  JointVector<N> velocity = JointVector<N>::Zero();  ///< v [rad/s or m/s], N x 1
};

/// One step of the classical Runge-Kutta method for dq/dt = v, dv/dt = acceleration(q, v). The
/// local error is of order step^5.   Source: [Kutta 1901]; [Hairer, Nørsett, Wanner 1993, table
/// II.1.2].
/// @param start         motion at the beginning of the step
/// @param step          h [s]
/// @param acceleration  callable with (q, v) -> JointVector<N> [rad/s^2 or m/s^2]
/// @return              motion at its end
/// Real-time: yes if `acceleration` is, which is called four times.
template <int N, class Acceleration>
[[nodiscard]] Motion<N> runge_kutta_step(const Motion<N>& start, double step,
                                         const Acceleration& acceleration) noexcept {
  const JointVector<N>& q = start.position;
  const JointVector<N>& v1 = start.velocity;
  const JointVector<N> a1 = acceleration(q, v1);
  const JointVector<N> v2 = v1 + step / 2 * a1;
  const JointVector<N> a2 = acceleration(q + step / 2 * v1, v2);
  const JointVector<N> v3 = v1 + step / 2 * a2;
  const JointVector<N> a3 = acceleration(q + step / 2 * v2, v3);
  const JointVector<N> v4 = v1 + step * a3;
  const JointVector<N> a4 = acceleration(q + step * v3, v4);
  return {q + step / 6 * (v1 + 2 * (v2 + v3) + v4), v1 + step / 6 * (a1 + 2 * (a2 + a3) + a4)};
}

}  // namespace articula
