// SPDX-License-Identifier: Apache-2.0
/// @file The fastest motion of one joint from rest to rest.
#pragma once

#include "articula/motion/cube_root.hpp"
#include "articula/motion/jerk_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The fastest motion from rest to rest over a distance D within the limits V, A, J of velocity,
/// acceleration and jerk. Its seven stretches have jerk +J 0 -J, cruise, -J 0 +J [Biagiotti,
/// Melchiorri 2008, section 3.4]. The highest acceleration and velocity are
///
///     a = min(A, sqrt(V J), cbrt(D J^2 / 2)),
///     v = min(V, (sqrt(b^2 + 4 a D) - b)/2) with b = a^2/J.
///
/// A distance below 1e-100 takes no time, so that powers of D do not vanish.
/// @param from          position at the start [rad or m]
/// @param to            position at the end [rad or m]
/// @param velocity      V [rad/s or m/s], as MotionLimits allows
/// @param acceleration  A [rad/s^2 or m/s^2], likewise
/// @param jerk          J [rad/s^3 or m/s^3], likewise
/// Real-time: yes.
[[nodiscard]] inline JerkMotion<7> rest_to_rest(double from, double to, double velocity,
                                                double acceleration, double jerk) noexcept {
  JerkMotion<7> motion({from, 0, 0});
  const double distance = std::abs(to - from);
  if (distance >= 1e-100) {
    const double side = to < from ? -1 : 1;
    const double a =
        std::min({acceleration, std::sqrt(velocity * jerk), cube_root(distance / 2 * jerk * jerk)});
    const double b = a * a / jerk;
    const double v = std::min(velocity, (std::sqrt(b * b + 4 * a * distance) - b) / 2);
    const double ramp = a / jerk, push = v / a - ramp, cruise = distance / v - (v / a + ramp);
    const double bend = std::min(b / 2, v / 2);  // what each stretch of jerk adds to the velocity
    motion.append(side * jerk, ramp, side * bend, side * a);
    motion.append(0, push, side * (v - bend), side * a);
    motion.append(-side * jerk, ramp, side * v, 0);
    motion.append(0, cruise, side * v, 0);
    motion.append(-side * jerk, ramp, side * (v - bend), -side * a);
    motion.append(0, push, side * bend, -side * a);
    motion.append(side * jerk, ramp, 0, 0);
  }
  motion.end_at({to, 0, 0});
  return motion;
}

}  // namespace articula
