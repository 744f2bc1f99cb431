// SPDX-License-Identifier: Apache-2.0
/// @file The way back from a state outside the limits of velocity and acceleration.
#pragma once

#include "articula/motion/jerk_motion.hpp"
#include "articula/motion/motion_limits.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// A motion between two states (StateToStateMotion): up to six stretches of braking_motion(), then
/// a mixture of two motions of seven stretches each.
using TransferMotion = JerkMotion<6 + 14>;

/// Brings an acceleration beyond its limit back to the limit at full jerk. The motion takes no time
/// if the acceleration is within its limits.
/// @param start   the motion at the start
/// @param bounds  limits that validate() accepts
/// Real-time: yes.
[[nodiscard]] inline TransferMotion limit_acceleration(const JointMotion& start,
                                                       const MotionBounds& bounds) noexcept {
  TransferMotion motion(start);
  motion.change_acceleration(bounds.jerk,
                             std::min(std::max(start.acceleration, bounds.lowest_acceleration),
                                      bounds.highest_acceleration));
  return motion;
}

/// Brings a joint to a state from which it can keep all limits, at full jerk. First, the
/// acceleration returns to its limit. Then the joint decelerates if the velocity is beyond its
/// limit or will pass it. It ends at the velocity limit, with a deceleration from which it can also
/// keep the opposite limit. The motion takes no time if the joint can keep its limits already.
/// @param start   the motion at the start
/// @param bounds  limits that validate() accepts
/// Real-time: yes.
[[nodiscard]] inline TransferMotion braking_motion(const JointMotion& start,
                                                   const MotionBounds& bounds) noexcept {
  TransferMotion motion = limit_acceleration(start, bounds);
  const double J = bounds.jerk, range = bounds.highest_velocity - bounds.lowest_velocity;
  for (const double side : {1.0, -1.0}) {
    const double limit = side > 0 ? bounds.highest_velocity : -bounds.lowest_velocity;
    double v = side * motion.end().velocity, a = side * motion.end().acceleration;
    const double reaches = v + std::max(0.0, a) * (a / 2 / J);
    if (reaches <= limit + 1e-12 * range) continue;  // rounding
    const double hardest = side > 0 ? -bounds.lowest_acceleration : bounds.highest_acceleration;
    const double end = std::min(hardest, std::sqrt(2 * J * range));  // deceleration at the limit
    // The deceleration rises to a peak. If the peak is above the final one, it falls to that.
    const double rise = a * a + 2 * J * (v - limit), both = (rise + end * end) / 2;
    const double peak =
        rise <= end * end ? std::sqrt(std::max(0.0, rise)) : std::min(hardest, std::sqrt(both));
    const double last = std::min(peak, end);
    if (-a <= peak) motion.change_acceleration(J, -side * peak);
    v = side * motion.end().velocity;
    a = side * motion.end().acceleration;
    const double over = v - limit - (a * a - last * last) / 2 / J;
    if (a < 0 && over > 0) motion.append(0, over / -a);
    if (-a > last) motion.change_acceleration(J, -side * last);
    const double rounding =
        1e-12 * (range + std::abs(v) + start.acceleration / J * start.acceleration);
    if (over >= -rounding) {
      motion.end_at({motion.end().position, side * limit, motion.end().acceleration});
    }
  }
  return motion;
}

}  // namespace articula
