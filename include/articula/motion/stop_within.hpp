// SPDX-License-Identifier: Apache-2.0
/// @file A stop that does not lead out of where a joint can be.
#pragma once

#include "articula/motion/jerk_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The fastest stop (fastest_stop) with the acceleration k A and the jerk k^2 J, where k >= 1 is as
/// small as it can be for the joint to stay in its range: 1 if it does so anyway. (With these
/// powers a stop from a mere velocity takes 1/k of the time and of the way.) At the range's end, or
/// where a nanosecond would be too long, as on a straight line that ends there, the joint stands at
/// once. One that is outside already goes no further out, if there is a k for that, or else takes
/// k = 1.
///
/// While an acceleration fades, the velocity changes by a^2/(2 J), which may be much where a
/// trajectory accelerates harder than A, or a speed override rises fast. What would lead beyond V,
/// or the velocity at the start where that is more, is dropped at once: the acceleration steps down
/// to sqrt(2 J (V - v)), position and velocity go on.
/// @param start         where it begins
/// @param velocity      V [rad/s or m/s], as MotionLimits allows
/// @param acceleration  A [rad/s^2 or m/s^2], as MotionLimits allows
/// @param jerk          J [rad/s^3 or m/s^3], likewise
/// @param lower, upper  the range [rad or m]; may be infinite
/// Real-time: yes. At most 65 stops are computed.
[[nodiscard]] inline JerkMotion stop_within(JointMotion start, double velocity, double acceleration,
                                            double jerk, double lower, double upper) noexcept {
  const double side = start.acceleration < 0 ? -1 : 1;
  const double most = std::max(velocity, std::abs(start.velocity));
  const double fading = std::sqrt(2 * jerk * std::max(0.0, most - side * start.velocity));
  if (side * start.acceleration > fading) start.acceleration = side * fading;
  const auto stop = [&](double k) noexcept {
    return fastest_stop(start, k * acceleration, k * k * jerk);
  };
  const double lowest = std::min(lower, start.position), highest = std::max(upper, start.position);
  const auto stays = [&](const JerkMotion& motion) noexcept {
    const PositionRange range = motion.positions();
    return range.lowest >= lowest && range.highest <= highest;
  };
  JerkMotion found = stop(1);
  if (stays(found)) return found;
  constexpr double shortest = 1e-9;    // [s]
  constexpr double hardest = 0x1p104;  // k^2 J is finite
  double enough = 4;
  JerkMotion harder = stop(enough);
  while (!stays(harder) || !(harder.duration() >= shortest)) {
    if (!(harder.duration() >= shortest) || enough >= hardest) {
      const bool outside = start.position < lower || start.position > upper;
      return outside ? found : JerkMotion({start.position, 0, 0});
    }
    enough *= 4;
    harder = stop(enough);
  }
  double little = enough / 4;
  for (int halving = 0; halving < 10; ++halving) {  // to 0.14 % of k
    const double middle = std::sqrt(little * enough);
    found = stop(middle);
    if (stays(found)) {
      harder = found;
      enough = middle;
    } else {
      little = middle;
    }
  }
  return harder;
}

}  // namespace articula
