// SPDX-License-Identifier: Apache-2.0
/// @file Motions of one joint in stretches of constant jerk, and the fastest ones of two kinds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace articula {

/// One joint at one moment.
struct JointMotion {
  double position = 0;      ///< q [rad or m]
  double velocity = 0;      ///< v [rad/s or m/s]
  double acceleration = 0;  ///< a [rad/s^2 or m/s^2]
};

/// Where a motion goes.
struct PositionRange {
  double lowest = 0;   ///< [rad or m]
  double highest = 0;  ///< [rad or m]
};

/// A motion of one joint in at most seven stretches of constant jerk, and no motion after them.
class JerkMotion {
 public:
  JerkMotion() = default;
  /// @param start  where it begins
  explicit JerkMotion(const JointMotion& start) noexcept : end_(start) {}

  /// Adds a stretch. What it ends with is given by the caller, who knows it exactly, so that
  /// rounding does not add up. Velocity and acceleration must not turn around within a stretch.
  /// @param jerk          [rad/s^3 or m/s^3]
  /// @param duration      [s]; a stretch of no or less duration adds nothing
  /// @param velocity      at its end [rad/s or m/s]
  /// @param acceleration  at its end [rad/s^2 or m/s^2]
  /// Real-time: yes.
  void append(double jerk, double duration, double velocity, double acceleration) noexcept {
    if (!(duration > 0) || size_ == stretches_.size()) return;
    stretches_[size_] = {duration_, jerk, end_};
    end_ = {advance(stretches_[size_], duration).position, velocity, acceleration};
    duration_ += duration;
    ++size_;
  }

  /// Where it rests after the last stretch, where that is known better than by adding up.
  /// Real-time: yes.
  void rest_at(double position) noexcept { end_ = {position, 0, 0}; }

  /// When it comes to rest [s].
  [[nodiscard]] double duration() const noexcept { return duration_; }
  /// Where it comes to rest.
  [[nodiscard]] const JointMotion& end() const noexcept { return end_; }

  /// The motion at a time from its start [s]; before it: the start. Velocity and acceleration lie
  /// between those at the ends of the stretch to the last bit.
  /// Real-time: yes. At most seven comparisons.
  [[nodiscard]] JointMotion sample(double time) const noexcept {
    if (!(time < duration_)) return end_;
    std::size_t k = 0;
    while (k + 1 < size_ && time >= stretches_[k + 1].start) ++k;
    const Stretch& stretch = stretches_[k];
    const JointMotion& from = stretch.from;
    const JointMotion& to = k + 1 < size_ ? stretches_[k + 1].from : end_;
    JointMotion motion = advance(stretch, std::max(0.0, time - stretch.start));
    motion.velocity = between(from.velocity, motion.velocity, to.velocity);
    motion.acceleration = between(from.acceleration, motion.acceleration, to.acceleration);
    return motion;
  }

  /// All positions on the way, start and end included. Real-time: yes.
  [[nodiscard]] PositionRange positions() const noexcept {
    PositionRange range{end_.position, end_.position};
    const auto add = [&](double position) noexcept {
      range = {std::min(range.lowest, position), std::max(range.highest, position)};
    };
    for (std::size_t k = 0; k < size_; ++k) {
      const JointMotion& from = stretches_[k].from;
      const JointMotion& to = k + 1 < size_ ? stretches_[k + 1].from : end_;
      add(from.position);
      const double side = from.velocity < 0 ? -1 : 1;
      if (!(side * to.velocity < 0)) continue;
      // The velocity falls to 0 once, since it does not turn around.
      const double v = side * from.velocity, a = side * from.acceleration;
      const double root = std::sqrt(std::max(0.0, a * a - 2 * side * stretches_[k].jerk * v));
      add(advance(stretches_[k], v > 0 ? 2 * v / (root - a) : 0).position);
    }
    return range;
  }

 private:
  struct Stretch {
    double start = 0;    ///< [s]
    double jerk = 0;     ///< [rad/s^3 or m/s^3]
    JointMotion from{};  ///< at its start
  };

  [[nodiscard]] static JointMotion advance(const Stretch& stretch, double t) noexcept {
    const auto& [q, v, a] = stretch.from;
    const double j = stretch.jerk;
    return {q + t * (v + t * (a / 2 + t * (j / 6))), v + t * (a + t * (j / 2)), a + t * j};
  }
  [[nodiscard]] static double between(double a, double x, double b) noexcept {
    return std::fmin(std::fmax(x, std::fmin(a, b)), std::fmax(a, b));
  }

  std::array<Stretch, 7> stretches_{};
  std::size_t size_ = 0;
  double duration_ = 0;
  JointMotion end_{};
};

/// The fastest motion from rest to rest over a distance D within the limits V, A, J of velocity,
/// acceleration and jerk: seven stretches, jerk +J 0 -J, cruise, -J 0 +J [Biagiotti, Melchiorri
/// 2008, section 3.4]. The highest acceleration and velocity are
///
///     a = min(A, sqrt(V J), cbrt(D J^2 / 2)),
///     v = min(V, (sqrt(b^2 + 4 a D) - b)/2) with b = a^2/J,
///
/// where the second terms are what D leaves time for. A distance below 1e-100 takes no time.
/// @param from          where it begins [rad or m]
/// @param to            where it ends [rad or m]
/// @param velocity      V [rad/s or m/s], as MotionLimits allows
/// @param acceleration  A [rad/s^2 or m/s^2], likewise
/// @param jerk          J [rad/s^3 or m/s^3], likewise
/// Real-time: yes.
[[nodiscard]] inline JerkMotion rest_to_rest(double from, double to, double velocity,
                                             double acceleration, double jerk) noexcept {
  JerkMotion motion({from, 0, 0});
  const double distance = std::abs(to - from);
  if (distance >= 1e-100) {
    const double side = to < from ? -1 : 1;
    const double a =
        std::min({acceleration, std::sqrt(velocity * jerk), std::cbrt(distance / 2 * jerk * jerk)});
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
  motion.rest_at(to);
  return motion;
}

/// The fastest stop: from any motion to rest, anywhere, within the limits A, J of acceleration and
/// jerk. Jerk leads the acceleration to -p, which is held, and back to zero, all against the
/// velocity that would be left if the acceleration just faded, v + a |a| / (2 J):
///
///     p = min(A, sqrt(J v + a^2 / 2)), against a, v > 0.
///
/// That is the time-optimal control of a double integrator from (v, a) to (0, 0) with bounded jerk
/// and acceleration. An acceleration beyond A is first led back at full jerk. While an
/// acceleration fades, the velocity grows by a^2 / (2 J), whatever one does.
/// @param start         where it begins
/// @param acceleration  A [rad/s^2 or m/s^2], as MotionLimits allows
/// @param jerk          J [rad/s^3 or m/s^3], likewise
/// Real-time: yes.
[[nodiscard]] inline JerkMotion fastest_stop(const JointMotion& start, double acceleration,
                                             double jerk) noexcept {
  JerkMotion motion(start);
  const double left = start.velocity + start.acceleration / 2 / jerk * std::abs(start.acceleration);
  const double side = left < 0 ? -1 : 1;
  double v = side * start.velocity, a = side * start.acceleration;
  const auto lead_to = [&](double target) {
    const double direction = target < a ? -1 : 1;
    v += direction * (target - a) * ((target + a) / 2 / jerk);
    motion.append(side * direction * jerk, std::abs(target - a) / jerk, side * v, side * target);
    a = target;
  };
  if (a > 0) lead_to(0);
  if (a < -acceleration) lead_to(-acceleration);
  const double peak =
      std::max(-a, std::min(acceleration, std::sqrt(std::max(0.0, jerk * v + a * (a / 2)))));
  lead_to(-peak);
  const double faded = peak * (peak / 2 / jerk);
  if (v > faded && peak > 0) {
    motion.append(0, (v - faded) / peak, side * faded, side * a);
    v = faded;
  }
  lead_to(0);
  motion.rest_at(motion.end().position);
  return motion;
}

}  // namespace articula
