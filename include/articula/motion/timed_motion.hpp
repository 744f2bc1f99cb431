// SPDX-License-Identifier: Apache-2.0
/// @file Motions of one joint between any two states, in stretches of constant jerk.
#pragma once

#include "articula/motion/jerk_motion.hpp"
#include "articula/motion/motion_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace articula {

/// A motion of one joint in stretches of constant jerk, whose end may move. After its end it goes on
/// with the acceleration that it ends with.
class TimedMotion {
 public:
  /// Two motions of at most seven stretches, mixed, and six before them.
  static constexpr std::size_t capacity = 6 + 14;

  TimedMotion() = default;
  /// @param start  where it begins
  explicit TimedMotion(const JointMotion& start) noexcept : end_(start) {}

  /// Adds a stretch.
  /// @param jerk      [rad/s^3 or m/s^3]
  /// @param duration  [s]; a stretch of no or less duration adds nothing
  /// Real-time: yes.
  void append(double jerk, double duration) noexcept {
    if (!(duration > 0) || size_ == capacity) return;
    stretches_[size_++] = {duration_, jerk, end_};
    end_ = advance(end_, jerk, duration);
    duration_ += duration;
  }

  /// Sets the end to what is known exactly, so that rounding does not add up.
  /// Real-time: yes.
  void end_at(const JointMotion& end) noexcept { end_ = end; }
  /// Sets the end and its time [s] likewise. Real-time: yes.
  void end_at(const JointMotion& end, double duration) noexcept {
    end_ = end;
    duration_ = duration;
  }

  /// How long it takes [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return duration_; }
  /// How it ends. Real-time: yes.
  [[nodiscard]] const JointMotion& end() const noexcept { return end_; }
  /// The number of its stretches. Real-time: yes.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// When a stretch begins [s]. Real-time: yes.
  [[nodiscard]] double start_of(std::size_t stretch) const noexcept {
    return stretch < size_ ? stretches_[stretch].start : duration_;
  }
  /// The jerk of a stretch [rad/s^3 or m/s^3]. Real-time: yes.
  [[nodiscard]] double jerk_of(std::size_t stretch) const noexcept {
    return stretches_[stretch].jerk;
  }

  /// The motion at a time from its start [s]; before it: the start. Accelerations lie between those
  /// at the ends of the stretch to the last bit, and velocities where the acceleration has one sign.
  /// Real-time: yes. O(log capacity).
  [[nodiscard]] JointMotion sample(double time) const noexcept {
    if (!(time < duration_) || size_ == 0) {
      return advance(end_, 0, std::max(0.0, time - duration_));
    }
    const auto later = [](double t, const Stretch& stretch) { return t < stretch.start; };
    const auto first = stretches_.begin() + 1;
    const auto next = std::upper_bound(
        first, stretches_.begin() + static_cast<std::ptrdiff_t>(size_), time, later);
    const Stretch& stretch = *(next - 1);
    const JointMotion& from = stretch.from;
    const auto k = static_cast<std::size_t>(next - stretches_.begin());
    const JointMotion& to = k < size_ ? stretches_[k].from : end_;
    JointMotion now = advance(from, stretch.jerk, std::max(0.0, time - stretch.start));
    now.acceleration = between(from.acceleration, now.acceleration, to.acceleration);
    if ((from.acceleration < 0) == (to.acceleration < 0)) {
      now.velocity = between(from.velocity, now.velocity, to.velocity);
    }
    return now;
  }

  /// All positions up to the end. Real-time: yes. O(capacity).
  [[nodiscard]] PositionRange positions() const noexcept {
    PositionRange range{end_.position, end_.position};
    const auto add = [&](double position) noexcept {
      range = {std::min(range.lowest, position), std::max(range.highest, position)};
    };
    for (std::size_t k = 0; k < size_; ++k) {
      const auto& [start, j, from] = stretches_[k];
      add(from.position);
      // v + a t + j t^2/2 = 0, in the form that does not cancel
      const double a = from.acceleration, v = from.velocity;
      const double root = std::sqrt(std::max(0.0, a * a - 2 * j * v));
      const double sum = -(a + std::copysign(root, a));
      for (const double t : {sum / j, 2 * v / sum}) {
        if (t > 0 && t < start_of(k + 1) - start) add(advance(from, j, t).position);
      }
    }
    return range;
  }

  /// Whether it keeps limits and has no jump. Where it starts beyond a limit, it may go as far as
  /// the start, and as the velocity does while the start's acceleration fades.
  /// Real-time: yes. O(capacity).
  [[nodiscard]] bool keeps(const MotionBounds& bounds) const noexcept {
    if (size_ == 0) return true;
    const auto& [q0, v0, a0] = stretches_[0].from;
    const double faded = v0 + a0 / 2 / bounds.jerk * std::abs(a0);
    const double slowest = std::min({bounds.lowest_velocity, v0, faded});
    const double fastest = std::max({bounds.highest_velocity, v0, faded});
    const double lowest = std::min(bounds.lowest_acceleration, a0);
    const double highest = std::max(bounds.highest_acceleration, a0);
    // What rounding may add to a limit, and a jump that no drive notices.
    constexpr double rounding = 1e-9, jump = 1e-6;
    const double v_slack = rounding * (fastest - slowest), a_slack = rounding * (highest - lowest);
    const auto has_velocity = [&](double v) noexcept {
      return v >= slowest - v_slack && v <= fastest + v_slack;
    };
    const double v_jump = jump * (fastest - slowest),
                 q_size = std::abs(q0) + std::abs(end_.position);
    const double q_jump = v_jump * duration_ + rounding * q_size;
    for (std::size_t k = 0; k < size_; ++k) {
      const auto& [start, j, from] = stretches_[k];
      const JointMotion& to = k + 1 < size_ ? stretches_[k + 1].from : end_;
      const JointMotion led = advance(from, j, start_of(k + 1) - start);
      if (!(std::abs(j) <= bounds.jerk * (1 + rounding)) || !has_velocity(to.velocity) ||
          !(to.acceleration >= lowest - a_slack && to.acceleration <= highest + a_slack) ||
          !(std::abs(led.velocity - to.velocity) <= v_jump) ||
          !(std::abs(led.position - to.position) <= q_jump)) {
        return false;
      }
      const double a = from.acceleration;  // where it passes 0, the velocity turns
      if (a * to.acceleration < 0 && !has_velocity(from.velocity - a * a / 2 / j)) return false;
    }
    return true;
  }

 private:
  struct Stretch {
    double start = 0;    ///< [s]
    double jerk = 0;     ///< [rad/s^3 or m/s^3]
    JointMotion from{};  ///< at its start
  };

  [[nodiscard]] static JointMotion advance(const JointMotion& from, double jerk,
                                           double t) noexcept {
    const auto& [q, v, a] = from;
    return {q + t * (v + t * (a / 2 + t * (jerk / 6))), v + t * (a + t * (jerk / 2)), a + t * jerk};
  }

  [[nodiscard]] static double between(double a, double x, double b) noexcept {
    return std::fmin(std::fmax(x, std::fmin(a, b)), std::fmax(a, b));
  }

  std::array<Stretch, capacity> stretches_{};
  std::size_t size_ = 0;
  double duration_ = 0;
  JointMotion end_{};
};

}  // namespace articula
