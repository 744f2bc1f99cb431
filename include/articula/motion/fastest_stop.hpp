// SPDX-License-Identifier: Apache-2.0
/// @file The fastest stop of one joint, anywhere or within a range of positions.
#pragma once

#include "articula/motion/jerk_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The fastest stop: from any motion to rest, at any position, within the limits A, J of
/// acceleration and jerk. The jerk changes the acceleration to -p, which is held, and back to zero.
/// This acts against v + a |a| / (2 J), the velocity that would be left if the acceleration faded:
///
///     p = min(A, sqrt(J v + a^2 / 2)), against a, v > 0.
///
/// That is the time-optimal control of a double integrator from (v, a) to (0, 0) with bounded jerk
/// and acceleration. An acceleration beyond A is first reduced to A at full jerk. While an
/// acceleration fades, the velocity grows by a^2 / (2 J) in any case.
/// @param start         the motion to stop
/// @param acceleration  A [rad/s^2 or m/s^2], as MotionLimits allows
/// @param jerk          J [rad/s^3 or m/s^3], likewise
/// Real-time: yes.
[[nodiscard]] inline JerkMotion<7> fastest_stop(const JointMotion& start, double acceleration,
                                                double jerk) noexcept {
  JerkMotion<7> motion(start);
  const double left = start.velocity + start.acceleration / 2 / jerk * std::abs(start.acceleration);
  const double side = left < 0 ? -1 : 1;
  double v = side * start.velocity, a = side * start.acceleration;
  const auto change_to = [&](double target) {
    const double direction = target < a ? -1 : 1;
    v += direction * (target - a) * ((target + a) / 2 / jerk);
    motion.append(side * direction * jerk, std::abs(target - a) / jerk, side * v, side * target);
    a = target;
  };
  if (a > 0) change_to(0);
  if (a < -acceleration) change_to(-acceleration);
  const double peak =
      std::max(-a, std::min(acceleration, std::sqrt(std::max(0.0, jerk * v + a * (a / 2)))));
  change_to(-peak);
  const double faded = peak * (peak / 2 / jerk);
  if (v > faded && peak > 0) {
    motion.append(0, (v - faded) / peak, side * faded, side * a);
    v = faded;
  }
  change_to(0);
  motion.end_at({motion.end().position, 0, 0});
  return motion;
}

/// The fastest stop (fastest_stop) within a range of positions, with the acceleration k A and the
/// jerk k^2 J. The factor k >= 1 is the smallest one with which the joint stays in the range. With
/// these powers a stop from a mere velocity takes 1/k of the time and of the distance.
///
/// - At the end of the range, and where the stop would take less than a nanosecond, the joint
///   stands at once.
/// - A joint that is outside already moves no further out, if some k allows that. Otherwise k = 1.
/// - While an acceleration fades, the velocity changes by a^2/(2 J). This may be much where a
///   trajectory accelerates harder than A. The part that would lead beyond V, or beyond the initial
///   velocity where that is higher, is dropped at once. The acceleration then steps down to sqrt(2
///   J (V - v)), while position and velocity do not jump.
///
/// @param start         the motion to stop
/// @param velocity      V [rad/s or m/s], as MotionLimits allows
/// @param acceleration  A [rad/s^2 or m/s^2], likewise
/// @param jerk          J [rad/s^3 or m/s^3], likewise
/// @param lower, upper  the range [rad or m]; may be infinite
/// Real-time: yes. At most 65 stops are computed.
[[nodiscard]] inline JerkMotion<7> stop_within(JointMotion start, double velocity,
                                               double acceleration, double jerk, double lower,
                                               double upper) noexcept {
  const double side = start.acceleration < 0 ? -1 : 1;
  const double most = std::max(velocity, std::abs(start.velocity));
  const double fading = std::sqrt(2 * jerk * std::max(0.0, most - side * start.velocity));
  if (side * start.acceleration > fading) start.acceleration = side * fading;
  const auto stop = [&](double k) noexcept {
    return fastest_stop(start, k * acceleration, k * k * jerk);
  };
  const ValueRange range = ValueRange{lower, upper}.extended_to(start.position);
  JerkMotion<7> found = stop(1);
  if (found.positions().is_within(range)) return found;
  constexpr double shortest = 1e-9;    // [s]
  constexpr double hardest = 0x1p104;  // k^2 J is finite
  double enough = 4;
  JerkMotion<7> harder = stop(enough);
  while (!harder.positions().is_within(range) || !(harder.duration() >= shortest)) {
    if (!(harder.duration() >= shortest) || enough >= hardest) {
      const bool outside = start.position < lower || start.position > upper;
      return outside ? found : JerkMotion<7>({start.position, 0, 0});
    }
    enough *= 4;
    harder = stop(enough);
  }
  double little = enough / 4;
  for (int halving = 0; halving < 10; ++halving) {  // to 0.14 % of k
    const double middle = std::sqrt(little * enough);
    found = stop(middle);
    if (found.positions().is_within(range)) {
      harder = found;
      enough = middle;
    } else {
      little = middle;
    }
  }
  return harder;
}

}  // namespace articula
