// SPDX-License-Identifier: Apache-2.0
/// @file The classical fourth-order Runge-Kutta method for equations of motion.
#pragma once

#include "articula/core/joint_state.hpp"

namespace articula {

/// One step of the classical Runge-Kutta method for dq/dt = v, dv/dt = acceleration(q, v). The
/// local error is of order step^5.   Source: [Kutta 1901]; [Hairer, Nørsett, Wanner 1993, table
/// II.1.2].
/// @param start         position and velocity at the beginning of the step
/// @param step          h [s]
/// @param acceleration  callable with (q, v) -> JointVector<N, S> [rad/s^2 or m/s^2]
/// @return              position and velocity at the end of the step; the effort of the start
/// Real-time: yes if `acceleration` is, which is called four times.
template <int N, class S = double, class Acceleration>
[[nodiscard]] JointState<N, S> runge_kutta_step(const JointState<N, S>& start, double step,
                                                const Acceleration& acceleration) noexcept {
  using Vector = JointVector<N, S>;
  const auto after = [](double time, const Vector& x, const Vector& rate) noexcept {
    return for_each_joint<N, S>([&](int j) noexcept { return x[j] + time * rate[j]; });
  };
  const auto at_end = [step](const Vector& x, const Vector& k1, const Vector& k2, const Vector& k3,
                             const Vector& k4) noexcept {
    return for_each_joint<N, S>(
        [&](int j) noexcept { return x[j] + step / 6 * (k1[j] + 2 * (k2[j] + k3[j]) + k4[j]); });
  };
  const Vector& q = start.position;
  const Vector& v1 = start.velocity;
  const Vector a1 = acceleration(q, v1);
  const Vector v2 = after(step / 2, v1, a1);
  const Vector a2 = acceleration(after(step / 2, q, v1), v2);
  const Vector v3 = after(step / 2, v1, a2);
  const Vector a3 = acceleration(after(step / 2, q, v2), v3);
  const Vector v4 = after(step, v1, a3);
  const Vector a4 = acceleration(after(step, q, v3), v4);
  return {at_end(q, v1, v2, v3, v4), at_end(v1, a1, a2, a3, a4), start.effort};
}

}  // namespace articula
