// SPDX-License-Identifier: Apache-2.0
/// @file The way back from a state outside of the limits of velocity and acceleration.
#pragma once

#include "articula/motion/motion_bounds.hpp"
#include "articula/motion/timed_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// Leads an acceleration beyond its limit back to it at full jerk, in no time if it is not beyond.
/// @param start   where it begins
/// @param bounds  limits as validate() accepts them
/// Real-time: yes.
[[nodiscard]] inline TimedMotion acceleration_led_back(const JointMotion& start,
                                                       const MotionBounds& bounds) noexcept {
  TimedMotion motion(start);
  const double a = std::min(std::max(start.acceleration, bounds.lowest_acceleration),
                            bounds.highest_acceleration);
  const double change = a - start.acceleration;
  motion.append(std::copysign(bounds.jerk, change), std::abs(change) / bounds.jerk);
  motion.end_at({motion.end().position, motion.end().velocity, a});
  return motion;
}

/// Leads a joint back to where all limits can be kept from then on: the acceleration to its limit;
/// then, if the velocity is beyond its limit or cannot be kept from it, a deceleration until it is
/// back, with which the joint can keep the opposite limit then. All at full jerk. It takes no time
/// from within the limits.
/// @param start   where it begins
/// @param bounds  limits as validate() accepts them
/// Real-time: yes.
[[nodiscard]] inline TimedMotion braking_motion(const JointMotion& start,
                                                const MotionBounds& bounds) noexcept {
  TimedMotion motion = acceleration_led_back(start, bounds);
  const double J = bounds.jerk, range = bounds.highest_velocity - bounds.lowest_velocity;
  const auto lead_acceleration_to = [&](double a) {
    const double change = a - motion.end().acceleration;
    motion.append(std::copysign(J, change), std::abs(change) / J);
    motion.end_at({motion.end().position, motion.end().velocity, a});
  };
  for (const double side : {1.0, -1.0}) {
    const double limit = side > 0 ? bounds.highest_velocity : -bounds.lowest_velocity;
    double v = side * motion.end().velocity, a = side * motion.end().acceleration;
    const double reaches = v + std::max(0.0, a) * (a / 2 / J);
    if (reaches <= limit + 1e-12 * range) continue;  // rounding
    const double hardest = side > 0 ? -bounds.lowest_acceleration : bounds.highest_acceleration;
    const double end = std::min(hardest, std::sqrt(2 * J * range));  // deceleration at the limit
    // The deceleration rises to a peak, and falls to the one at the limit if it is above that.
    const double rise = a * a + 2 * J * (v - limit), both = (rise + end * end) / 2;
    const double peak =
        rise <= end * end ? std::sqrt(std::max(0.0, rise)) : std::min(hardest, std::sqrt(both));
    const double last = std::min(peak, end);
    if (-a <= peak) lead_acceleration_to(-side * peak);
    v = side * motion.end().velocity;
    a = side * motion.end().acceleration;
    const double over = v - limit - (a * a - last * last) / 2 / J;
    if (a < 0 && over > 0) motion.append(0, over / -a);
    if (-a > last) lead_acceleration_to(-side * last);
    const double rounding =
        1e-12 * (range + std::abs(v) + start.acceleration / J * start.acceleration);
    if (over >= -rounding) {
      motion.end_at({motion.end().position, side * limit, motion.end().acceleration});
    }
  }
  return motion;
}

}  // namespace articula
