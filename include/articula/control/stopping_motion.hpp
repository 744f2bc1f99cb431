// SPDX-License-Identifier: Apache-2.0
/// @file How a joint comes to rest, cycle by cycle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace articula {

/// One joint's command in a cycle. Commands come once per cycle, dt apart, so differences take the
/// place of derivatives: v_k = (q_k - q_(k-1))/dt and a_k = (v_k - v_(k-1))/dt.
struct CommandMotion {
  double position = 0;      ///< q_k [rad or m]
  double velocity = 0;      ///< v_k [rad/s or m/s]
  double acceleration = 0;  ///< a_k [rad/s^2 or m/s^2]
};

/// Lowest and highest values of something.
struct ValueRange {
  double lowest = 0;
  double highest = 0;
};

/// A way from any motion to rest within limits B of acceleration and J of jerk, in whole cycles: the
/// acceleration goes in n1 equal steps to -p (against the motion), rests there for n2 cycles, and
/// goes in n3 equal steps to 0. From v and a, the velocity is 0 at the end for
///
///     p = (v/dt + a (n1 - 1)/2) / ((n1 + n3)/2 + n2).
///
/// n1, n2, n3 are the times of the fastest stop in continuous time (from v' = v - a dt/2 and a, p
/// would be min(B, sqrt(J v' + a^2/2))), rounded to cycles so that p and its steps stay within the
/// limits. From one cycle to the next it is the same stop, less one cycle; so whoever has one in
/// hand, and at any time goes on with it or with a motion that has another, can always come to rest.
class StoppingMotion {
 public:
  /// At rest, for ever.
  StoppingMotion() = default;

  /// @param from          where it begins
  /// @param deceleration  B > 0 [rad/s^2 or m/s^2]
  /// @param jerk          J > 0 [rad/s^3 or m/s^3]
  /// @param period        dt > 0 [s]
  /// Real-time: yes. O(1), however long it takes.
  StoppingMotion(const CommandMotion& from, double deceleration, double jerk,
                 double period) noexcept
      : period_(period), motion_(from) {
    const double step = jerk * period;  // how far the acceleration goes in a cycle
    const double fading = cycles(std::abs(from.acceleration) / step);
    const double left = from.velocity + from.acceleration * period * std::max(0.0, fading - 1) / 2;
    const double side = left < 0 ? -1 : 1;
    const double v = side * from.velocity, a = side * from.acceleration;
    const double peak = std::sqrt(std::max(0.0, jerk * (v - a * period / 2) + a * a / 2));
    const double p = std::min(deceleration, std::max(-a, peak));
    const double n1 = std::max(1.0, cycles(std::abs(a + p) / step));
    const double n3 = std::max(1.0, cycles(p / step));
    feasible_ = fit(side, v, a, deceleration, step, n1, n3) ||
                (n3 > 1 && fit(side, v, a, deceleration, step, n1, n3 - 1));
  }

  /// Whether acceleration and jerk keep their limits. They may not where rounding to cycles is
  /// coarse; it ends at rest all the same.
  [[nodiscard]] bool feasible() const noexcept { return feasible_; }

  /// Where the joint is now. Real-time: yes.
  [[nodiscard]] const CommandMotion& motion() const noexcept { return motion_; }

  /// Goes on by one cycle. Real-time: yes.
  void advance() noexcept {
    while (current_ < stretches_.size() && !(stretches_[current_].cycles > 0)) ++current_;
    if (current_ == stretches_.size()) {
      motion_ = {motion_.position, 0, 0};
      return;
    }
    motion_ = after(motion_, stretches_[current_].change, 1);
    stretches_[current_].cycles -= 1;
  }

  /// The same stop elsewhere. Real-time: yes.
  void move_to(double position) noexcept { motion_.position = position; }

  /// All positions on the way, the present one included [rad or m]. Real-time: yes.
  [[nodiscard]] ValueRange positions() const noexcept {
    return range(&CommandMotion::position, [this](const CommandMotion& m, double c) {
      // v_i = v + dt (i a + c i (i + 1)/2) changes its sign where
      const double half_square = c * period_ / 2, linear = period_ * m.acceleration + half_square;
      if (half_square == 0) return ValueRange{-m.velocity / linear, -m.velocity / linear};
      const double root = std::sqrt(linear * linear - 4 * half_square * m.velocity);
      return ValueRange{(-linear - root) / (2 * half_square), (-linear + root) / (2 * half_square)};
    });
  }

  /// All velocities on the way, the present one included [rad/s or m/s]. Real-time: yes.
  [[nodiscard]] ValueRange velocities() const noexcept {
    return range(&CommandMotion::velocity, [](const CommandMotion& m, double c) {
      return ValueRange{-m.acceleration / c, -m.acceleration / c};  // where a_i changes its sign
    });
  }

 private:
  /// A number of cycles in each of which the acceleration changes by the same.
  struct Stretch {
    double cycles = 0;
    double change = 0;  ///< [rad/s^2 or m/s^2]
  };

  /// Rounds up, but not for rounding's sake.
  [[nodiscard]] static double cycles(double count) noexcept { return std::ceil(count - 1e-9); }

  /// The motion n cycles later, the acceleration changing by c in each.
  [[nodiscard]] CommandMotion after(const CommandMotion& m, double c, double n) const noexcept {
    const double ones = n, sum = n * (n + 1) / 2, sums = sum * (n + 2) / 3;
    return {
        m.position + period_ * (ones * m.velocity + period_ * (sum * m.acceleration + sums * c)),
        m.velocity + period_ * (ones * m.acceleration + sum * c), m.acceleration + ones * c};
  }

  /// Makes the stop of n1 and n3 cycles; n2 is as small as the limits allow.
  /// @return whether they allow it
  bool fit(double side, double v, double a, double deceleration, double step, double n1,
           double n3) noexcept {
    const double lost = v / period_ + a * (n1 - 1) / 2;
    const double most = std::min({deceleration, n3 * step, n1 * step - a});
    const double n2 = most > 0 ? std::max(0.0, cycles(lost / most - (n1 + n3) / 2)) : 0;
    const double p = lost / ((n1 + n3) / 2 + n2);
    stretches_ = {{{n1, side * (-p - a) / n1}, {n2, 0}, {n3, side * p / n3}}};
    constexpr double rounding = 1e-9;
    return p >= -rounding * step && p <= most + rounding * step &&
           -p - a <= n1 * step * (1 + rounding);
  }

  /// The range of a quantity, found at the ends of the stretches and next to its turning points.
  template <class TurningPoints>
  [[nodiscard]] ValueRange range(double CommandMotion::*quantity,
                                 TurningPoints turning_points) const noexcept {
    CommandMotion m = motion_;
    ValueRange values{m.*quantity, m.*quantity};
    const auto add = [&](double value) {
      values = {std::min(values.lowest, value), std::max(values.highest, value)};
    };
    for (std::size_t k = current_; k < stretches_.size(); ++k) {
      const auto& [n, c] = stretches_[k];
      const ValueRange points = turning_points(m, c);
      for (const double point : {points.lowest, points.highest}) {
        if (point > 0 && point < n) add(after(m, c, std::floor(point)).*quantity);
      }
      m = after(m, c, n);
      add(m.*quantity);
    }
    return values;
  }

  double period_ = 1;  ///< dt [s]
  CommandMotion motion_{};
  std::array<Stretch, 3> stretches_{};
  std::size_t current_ = 0;
  bool feasible_ = true;
};

}  // namespace articula
