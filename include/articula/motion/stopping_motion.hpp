// SPDX-License-Identifier: Apache-2.0
/// @file How a joint comes to rest, cycle by cycle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace articula {

/// One joint's command in a cycle. Commands come once per cycle, dt apart, so
/// differences take the place of derivatives: v_k = (q_k - q_(k-1))/dt and a_k
/// = (v_k - v_(k-1))/dt.
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

/// A way from any motion to rest within limits B of acceleration and J of jerk, about as fast as
/// whole cycles allow: the deceleration, at first its present value d, grows in steps of s = J dt
/// to a level p <= B, stays there, and goes in such steps back to 0. A larger d first goes back to
/// B.
///
/// n steps lead to p = d + n s and take n d + s n (n + 1)/2 of what is to be lost, v/dt. The way
/// back takes (p - s) + (p - 2 s) + ... + (p - m s), m = ceil(p/s) - 1. n is the largest number for
/// which that is not too much; in continuous time p = sqrt(J v + d^2/2) [Biagiotti, Melchiorri
/// 2008, section 3.4], of which sums over cycles make J v + d (d + s)/2. What is left to lose is
/// taken by a smaller step to one more level, p + s at most, or p - s at least.
///
/// There is such a way from every motion whose acceleration is within B. And as it begins with the
/// largest steps, no other way to rest within the limits has a lower highest velocity.
class StoppingMotion {
 public:
  /// At rest, for ever.
  StoppingMotion() = default;

  /// @param from          where it begins
  /// @param deceleration  B > 0 [rad/s^2 or m/s^2]; a joint that brakes harder already takes that
  ///                      back
  /// @param jerk          J > 0 [rad/s^3 or m/s^3]
  /// @param period        dt > 0 [s]
  /// Real-time: yes. O(1), however long it takes.
  StoppingMotion(const CommandMotion& from, double deceleration, double jerk,
                 double period) noexcept
      : period_(period), step_(jerk * period), motion_(from) {
    const double rest = from.velocity / period +
                        std::copysign(way_back(std::abs(from.acceleration)), from.acceleration);
    side_ = rest < 0 ? -1 : 1;
    plan(-side_ * from.acceleration, side_ * from.velocity / period, deceleration);
  }

  /// Where the joint is now. Real-time: yes.
  [[nodiscard]] const CommandMotion& motion() const noexcept { return motion_; }

  /// Goes on by one cycle. Real-time: yes.
  void advance() noexcept {
    if (current_ == count_) {
      motion_ = {motion_.position, 0, 0};
      return;
    }
    Stretch& stretch = stretches_[current_];
    motion_ = after(motion_, stretch.change, 1);
    stretch.cycles -= 1;
    if (!(stretch.cycles > 0)) ++current_;
  }

  /// The same stop elsewhere. Real-time: yes.
  void move_to(double position) noexcept { motion_.position = position; }

  /// All positions on the way, the present one included [rad or m]. Real-time:
  /// yes.
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

  /// Rounds up and down, but not for rounding's sake.
  [[nodiscard]] static double up(double count) noexcept { return std::ceil(count - 1e-9); }
  [[nodiscard]] static double down(double count) noexcept { return std::floor(count + 1e-9); }

  /// How many whole steps lie between a level and 0, which the last step reaches.
  [[nodiscard]] double steps_back(double level) const noexcept {
    return std::max(0.0, up(level / step_) - 1);
  }
  /// What is lost while the deceleration goes back from a level to 0.
  [[nodiscard]] double way_back(double level) const noexcept {
    const double m = steps_back(level);
    return m * level - step_ * m * (m + 1) / 2;
  }

  /// @param d     deceleration at the beginning; negative while the joint accelerates
  /// @param lost  what is to be lost of velocity/dt
  /// @param most  B
  void plan(double d, double lost, double most) noexcept {
    const bool is_too_high = d > most;
    const double n =
        is_too_high ? std::max(0.0, up((d - most) / step_) - 1) : steps_up(d, lost, most);
    const double step = is_too_high ? -step_ : step_;
    add(n, step);
    const double level = d + n * step, left = lost - (n * d + step * n * (n + 1) / 2);
    const double next = std::min(level_for(left), most);
    add(1, next - level);
    stay(next, left - next);
  }

  /// How many whole steps the deceleration grows at first.
  [[nodiscard]] double steps_up(double d, double lost, double most) const noexcept {
    const auto fits = [&](double n) {
      const double level = d + n * step_;
      return level <= most && n * d + step_ * n * (n + 1) / 2 + way_back(level) <= lost;
    };
    const double fewest = d < 0 ? up(-d / step_) : 0;
    const double peak = std::sqrt(std::max(0.0, step_ * lost + d * (d + step_) / 2));
    double n = std::max(fewest, down((std::min(peak, most) - d) / step_));
    for (int k = 0; k < 2 && fits(n + 1); ++k) ++n;
    for (int k = 0; k < 2 && n > fewest && !fits(n); ++k) --n;
    // The first level beyond 0 may be too much already.
    return n == fewest && !fits(n) ? std::max(0.0, fewest - 1) : n;
  }

  /// The level from which one cycle there and the way back lose as much as said. At m s it is
  /// s m (m + 1)/2, and between those it grows in proportion.
  [[nodiscard]] double level_for(double lost) const noexcept {
    if (!(lost > 0)) return 0;
    const double m = down((std::sqrt(1 + 8 * lost / step_) - 1) / 2);
    return (lost + step_ * m * (m + 1) / 2) / (m + 1);
  }

  /// Stays at a level for as long as more is to be lost than on the way back, and goes that way.
  void stay(double level, double lost) noexcept {
    const double n = level > 0 ? down((lost - way_back(level)) / level) : 0;
    add(n, 0);
    const double next = level_for(lost - n * level);
    add(1, next - level);
    if (!(next > 0)) return;
    const double m = steps_back(next);
    add(m, -step_);
    add(1, m * step_ - next);
  }

  /// @param change  of the deceleration, in each cycle
  void add(double cycles, double change) noexcept {
    if (cycles > 0) stretches_[count_++] = {cycles, -side_ * change};
  }

  /// The motion n cycles later, the acceleration changing by c in each.
  [[nodiscard]] CommandMotion after(const CommandMotion& m, double c, double n) const noexcept {
    const double ones = n, sum = n * (n + 1) / 2, sums = sum * (n + 2) / 3;
    return {
        m.position + period_ * (ones * m.velocity + period_ * (sum * m.acceleration + sums * c)),
        m.velocity + period_ * (ones * m.acceleration + sum * c), m.acceleration + ones * c};
  }

  /// The range of a quantity, found at the ends of the stretches and next to
  /// its turning points.
  template <class TurningPoints>
  [[nodiscard]] ValueRange range(double CommandMotion::* quantity,
                                 TurningPoints turning_points) const noexcept {
    CommandMotion m = motion_;
    ValueRange values{m.*quantity, m.*quantity};
    const auto add = [&](double value) {
      values = {std::min(values.lowest, value), std::max(values.highest, value)};
    };
    for (std::size_t k = current_; k < count_; ++k) {
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
  double step_ = 1;    ///< s [rad/s^2 or m/s^2]
  double side_ = 1;    ///< of the velocity that is to be lost
  CommandMotion motion_{};
  std::array<Stretch, 6> stretches_{};
  std::size_t current_ = 0;
  std::size_t count_ = 0;
};

}  // namespace articula
