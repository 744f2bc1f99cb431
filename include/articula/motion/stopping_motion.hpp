// SPDX-License-Identifier: Apache-2.0
/// @file The fastest stop of one joint on the grid of control cycles.
#pragma once

#include "articula/motion/joint_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace articula {

/// A stop of one joint within limits B of deceleration and J of jerk, in whole cycles. It is about
/// as fast as whole cycles allow. The deceleration starts at its present value d and grows in steps
/// of s = J dt to a level p <= B. It stays there, and returns to 0 in such steps. A deceleration
/// above B first returns to B.
///
/// n steps lead to p = d + n s and reduce v/dt by n d + s n (n + 1)/2. The return to 0 reduces it
/// by (p - s) + (p - 2 s) + ... + (p - m s), m = ceil(p/s) - 1. n is the largest number for which
/// the sum does not exceed v/dt. In continuous time p = sqrt(J v + d^2/2) [Biagiotti, Melchiorri
/// 2008, section 3.4]; sums over cycles turn this into J v + d (d + s)/2. One cycle at another
/// level, at most s away from p, removes the rest of the velocity.
///
/// Every motion whose acceleration is within B has such a stop. As it begins with the largest
/// steps, no other stop within the limits has a lower highest velocity.
///
/// The class is a plain value: the present motion and the rest of the plan. advance() moves it on
/// by one cycle.
class StoppingMotion {
 public:
  /// At rest.
  StoppingMotion() = default;

  /// @param from          the motion to stop
  /// @param deceleration  B > 0 [rad/s^2 or m/s^2]
  /// @param jerk          J > 0 [rad/s^3 or m/s^3]
  /// @param period        dt > 0 [s]
  /// Real-time: yes. O(1) for any duration of the stop.
  StoppingMotion(const JointMotion& from, double deceleration, double jerk, double period) noexcept
      : period_(period), step_(jerk * period), motion_(from) {
    const double rest =
        from.velocity / period +
        std::copysign(lost_on_return(std::abs(from.acceleration)), from.acceleration);
    side_ = rest < 0 ? -1 : 1;
    plan(-side_ * from.acceleration, side_ * from.velocity / period, deceleration);
  }

  /// The present motion. Real-time: yes.
  [[nodiscard]] const JointMotion& motion() const noexcept { return motion_; }
  /// The length of a cycle, dt [s]. Real-time: yes.
  [[nodiscard]] double period() const noexcept { return period_; }

  /// Moves on by one cycle. Real-time: yes.
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

  /// Shifts the stop to another present position [rad or m]. Real-time: yes.
  void move_to(double position) noexcept { motion_.position = position; }

  /// The range of positions, the present one included [rad or m]. Real-time: yes.
  [[nodiscard]] ValueRange positions() const noexcept {
    return range(&JointMotion::position, [this](const JointMotion& m, double c) {
      // v_i = v + dt (i a + c i (i + 1)/2) changes its sign where
      const double half_square = c * period_ / 2, linear = period_ * m.acceleration + half_square;
      if (half_square == 0) return ValueRange{-m.velocity / linear, -m.velocity / linear};
      const double root = std::sqrt(linear * linear - 4 * half_square * m.velocity);
      return ValueRange{(-linear - root) / (2 * half_square), (-linear + root) / (2 * half_square)};
    });
  }

  /// The range of velocities, the present one included [rad/s or m/s]. Real-time: yes.
  [[nodiscard]] ValueRange velocities() const noexcept {
    return range(&JointMotion::velocity, [](const JointMotion& m, double c) {
      return ValueRange{-m.acceleration / c, -m.acceleration / c};  // where a_i changes its sign
    });
  }

 private:
  /// A number of cycles with the same change of the acceleration in each.
  struct Stretch {
    double cycles = 0;
    double change = 0;  ///< [rad/s^2 or m/s^2]
  };

  /// The next integer above and below. A count that is an integer but for rounding stays.
  [[nodiscard]] static double up(double count) noexcept { return std::ceil(count - 1e-9); }
  [[nodiscard]] static double down(double count) noexcept { return std::floor(count + 1e-9); }

  /// The number of whole steps from a level down to 0, without the last one.
  [[nodiscard]] double steps_back(double level) const noexcept {
    return std::max(0.0, up(level / step_) - 1);
  }
  /// The reduction of v/dt while the deceleration returns from a level to 0.
  [[nodiscard]] double lost_on_return(double level) const noexcept {
    const double m = steps_back(level);
    return m * level - step_ * m * (m + 1) / 2;
  }

  /// Computes the stretches.
  /// @param d     deceleration at the beginning; negative while the joint accelerates
  /// @param lost  v/dt, which the stop removes
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

  /// The number of whole steps in which the deceleration grows at first.
  [[nodiscard]] double steps_up(double d, double lost, double most) const noexcept {
    const auto fits = [&](double n) {
      const double level = d + n * step_;
      return level <= most && n * d + step_ * n * (n + 1) / 2 + lost_on_return(level) <= lost;
    };
    const double fewest = d < 0 ? up(-d / step_) : 0;
    const double peak = std::sqrt(std::max(0.0, step_ * lost + d * (d + step_) / 2));
    double n = std::max(fewest, down((std::min(peak, most) - d) / step_));
    for (int k = 0; k < 2 && fits(n + 1); ++k) ++n;
    for (int k = 0; k < 2 && n > fewest && !fits(n); ++k) --n;
    // The first level beyond 0 may already remove too much.
    return n == fewest && !fits(n) ? std::max(0.0, fewest - 1) : n;
  }

  /// The level at which one cycle and the return to 0 remove a given amount. A level m s removes
  /// s m (m + 1)/2. Between such levels the amount is linear.
  [[nodiscard]] double level_for(double lost) const noexcept {
    if (!(lost > 0)) return 0;
    const double m = down((std::sqrt(1 + 8 * lost / step_) - 1) / 2);
    return (lost + step_ * m * (m + 1) / 2) / (m + 1);
  }

  /// Adds the cycles at a level until only the loss on return is left, and the return.
  void stay(double level, double lost) noexcept {
    const double n = level > 0 ? down((lost - lost_on_return(level)) / level) : 0;
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

  /// The motion n cycles later, if the acceleration changes by c in each.
  [[nodiscard]] JointMotion after(const JointMotion& m, double c, double n) const noexcept {
    const double ones = n, sum = n * (n + 1) / 2, sums = sum * (n + 2) / 3;
    return {
        m.position + period_ * (ones * m.velocity + period_ * (sum * m.acceleration + sums * c)),
        m.velocity + period_ * (ones * m.acceleration + sum * c), m.acceleration + ones * c};
  }

  /// The range of a quantity, which has its extremes at the ends of stretches or next to turning
  /// points.
  template <class TurningPoints>
  [[nodiscard]] ValueRange range(double JointMotion::* quantity,
                                 TurningPoints turning_points) const noexcept {
    JointMotion m = motion_;
    ValueRange values{m.*quantity, m.*quantity};
    for (std::size_t k = current_; k < count_; ++k) {
      const auto& [n, c] = stretches_[k];
      const ValueRange points = turning_points(m, c);
      for (const double point : {points.lowest, points.highest}) {
        if (!(point > 0 && point < n)) continue;
        values = values.extended_to(after(m, c, std::floor(point)).*quantity);
      }
      m = after(m, c, n);
      values = values.extended_to(m.*quantity);
    }
    return values;
  }

  double period_ = 1;  ///< dt [s]
  double step_ = 1;    ///< s [rad/s^2 or m/s^2]
  double side_ = 1;    ///< sign of the velocity that the stop removes
  JointMotion motion_{};
  std::array<Stretch, 6> stretches_{};
  std::size_t current_ = 0;
  std::size_t count_ = 0;
};

}  // namespace articula
