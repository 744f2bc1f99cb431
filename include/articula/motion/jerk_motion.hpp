// SPDX-License-Identifier: Apache-2.0
/// @file A motion of one joint in stretches of constant jerk.
#pragma once

#include "articula/motion/joint_motion.hpp"
#include "articula/motion/motion_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace articula {

/// A motion of one joint in stretches of constant jerk. After its end, the joint goes on with the
/// acceleration of the end: at rest, if the motion ends at rest.
///
///     JerkMotion<2> motion({.position = 1});
///     motion.append(4, 0.5);   // jerk 4 rad/s^3 for 0.5 s
///     motion.append(-4, 0.5);
///     motion.sample(0.7).velocity;
///
/// Functions that solve for such a motion are rest_to_rest(), fastest_stop(), stop_within() and
/// braking_motion(), and the class StateToStateMotion.
/// @tparam Capacity  largest number of stretches
template <std::size_t Capacity>
class JerkMotion {
 public:
  JerkMotion() = default;
  /// @param start  the motion at time 0
  explicit JerkMotion(const JointMotion& start) noexcept : end_(start) {}

  /// Adds a stretch.
  /// @param jerk      [rad/s^3 or m/s^3]
  /// @param duration  [s]; a stretch of zero or negative duration adds nothing
  /// Real-time: yes.
  void append(double jerk, double duration) noexcept {
    if (add(jerk, duration)) end_ = advance(end_, jerk, duration);
  }
  /// Adds a stretch whose final velocity [rad/s or m/s] and acceleration [rad/s^2 or m/s^2] the
  /// caller knows exactly, so that rounding does not accumulate. Real-time: yes.
  void append(double jerk, double duration, double velocity, double acceleration) noexcept {
    if (add(jerk, duration)) {
      end_ = {advance(end_, jerk, duration).position, velocity, acceleration};
    }
  }
  /// Adds the stretch that changes the acceleration at full jerk.
  /// @param jerk          J > 0 [rad/s^3 or m/s^3]
  /// @param acceleration  at the end of the stretch [rad/s^2 or m/s^2]
  /// Real-time: yes.
  void change_acceleration(double jerk, double acceleration) noexcept {
    const double change = acceleration - end_.acceleration;
    append(std::copysign(jerk, change), std::abs(change) / jerk);
    end_.acceleration = acceleration;
  }

  /// Replaces the end by a motion that is known exactly, so that rounding does not accumulate.
  /// Real-time: yes.
  void end_at(const JointMotion& end) noexcept { end_ = end; }
  /// Replaces the end and its time [s] likewise. Real-time: yes.
  void end_at(const JointMotion& end, double duration) noexcept {
    end_ = end;
    duration_ = duration;
  }

  /// The time of the end [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return duration_; }
  /// The motion at the end. Real-time: yes.
  [[nodiscard]] const JointMotion& end() const noexcept { return end_; }
  /// The number of stretches. Real-time: yes.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// The time at which a stretch begins [s]. Real-time: yes.
  [[nodiscard]] double start_of(std::size_t stretch) const noexcept {
    return stretch < size_ ? stretches_[stretch].start : duration_;
  }
  /// The jerk of a stretch [rad/s^3 or m/s^3]. Real-time: yes.
  [[nodiscard]] double jerk_of(std::size_t stretch) const noexcept {
    return stretches_[stretch].jerk;
  }

  /// The motion at a time [s]; before 0: the start. Accelerations lie between those at the ends of
  /// the stretch to the last bit. So do velocities where the acceleration keeps its sign.
  /// Real-time: yes. O(Capacity).
  [[nodiscard]] JointMotion sample(double time) const noexcept {
    if (!(time < duration_) || size_ == 0) {
      const bool rests = end_.velocity == 0 && end_.acceleration == 0;  // also at time infinity
      return rests ? end_ : advance(end_, 0, std::max(0.0, time - duration_));
    }
    std::size_t k = 0;
    while (k + 1 < size_ && time >= stretches_[k + 1].start) ++k;
    const auto& [start, jerk, from] = stretches_[k];
    const JointMotion& to = k + 1 < size_ ? stretches_[k + 1].from : end_;
    JointMotion now = advance(from, jerk, std::max(0.0, time - start));
    now.acceleration = between(from.acceleration, now.acceleration, to.acceleration);
    if (from.acceleration * to.acceleration >= 0) {
      now.velocity = between(from.velocity, now.velocity, to.velocity);
    }
    return now;
  }

  /// The range of positions from the start to the end. Real-time: yes. O(Capacity).
  [[nodiscard]] ValueRange positions() const noexcept {
    ValueRange range{end_.position, end_.position};
    for (std::size_t k = 0; k < size_; ++k) {
      const auto& [start, j, from] = stretches_[k];
      range = range.extended_to(from.position);
      const JointMotion& to = k + 1 < size_ ? stretches_[k + 1].from : end_;
      if (from.velocity * to.velocity >= 0 && from.acceleration * to.acceleration >= 0) continue;
      // The joint turns where v + a t + j t^2/2 = 0, solved in the form that does not cancel.
      const double a = from.acceleration, v = from.velocity;
      const double root = std::sqrt(std::max(0.0, a * a - 2 * j * v));
      const double sum = -(a + std::copysign(root, a));
      for (const double t : {sum / j, 2 * v / sum}) {
        if (t > 0 && t < start_of(k + 1) - start) {
          range = range.extended_to(advance(from, j, t).position);
        }
      }
    }
    return range;
  }

  /// Whether the motion keeps limits and has no jump. A motion that starts beyond a limit may go as
  /// far as its start. It may also go as far as the velocity goes while the initial acceleration
  /// fades.
  /// Real-time: yes. O(Capacity).
  [[nodiscard]] bool keeps(const MotionBounds& bounds) const noexcept {
    if (size_ == 0) return true;
    const auto& [q0, v0, a0] = stretches_[0].from;
    const double faded = v0 + a0 / 2 / bounds.jerk * std::abs(a0);
    const double slowest = std::min({bounds.lowest_velocity, v0, faded});
    const double fastest = std::max({bounds.highest_velocity, v0, faded});
    const double lowest = std::min(bounds.lowest_acceleration, a0);
    const double highest = std::max(bounds.highest_acceleration, a0);
    // What rounding may add to a limit, and a jump too small for any drive to follow.
    constexpr double rounding = 1e-9, jump = 1e-6;
    const double v_slack = rounding * (fastest - slowest), a_slack = rounding * (highest - lowest);
    const auto has_velocity = [&](double v) noexcept {
      return v >= slowest - v_slack && v <= fastest + v_slack;
    };
    const double v_jump = jump * (fastest - slowest);
    const double q_jump = v_jump * duration_ + rounding * (std::abs(q0) + std::abs(end_.position));
    for (std::size_t k = 0; k < size_; ++k) {
      const auto& [start, j, from] = stretches_[k];
      const JointMotion& to = k + 1 < size_ ? stretches_[k + 1].from : end_;
      const JointMotion computed = advance(from, j, start_of(k + 1) - start);
      if (!(std::abs(j) <= bounds.jerk * (1 + rounding)) || !has_velocity(to.velocity) ||
          !(to.acceleration >= lowest - a_slack && to.acceleration <= highest + a_slack) ||
          !(std::abs(computed.velocity - to.velocity) <= v_jump) ||
          !(std::abs(computed.position - to.position) <= q_jump)) {
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

  /// Adds a stretch whose end the caller sets.
  /// @return false if it would take no time, or the motion is full
  [[nodiscard]] bool add(double jerk, double duration) noexcept {
    if (!(duration > 0) || size_ == Capacity) return false;
    stretches_[size_++] = {duration_, jerk, end_};
    duration_ += duration;
    return true;
  }

  [[nodiscard]] static JointMotion advance(const JointMotion& from, double jerk,
                                           double t) noexcept {
    const auto& [q, v, a] = from;
    return {q + t * (v + t * (a / 2 + t * (jerk / 6))), v + t * (a + t * (jerk / 2)), a + t * jerk};
  }
  /// x, clamped to the range between a and b in either order.
  [[nodiscard]] static double between(double a, double x, double b) noexcept {
    return std::min(std::max(std::min(a, b), x), std::max(a, b));
  }

  std::array<Stretch, Capacity> stretches_{};
  std::size_t size_ = 0;
  double duration_ = 0;
  JointMotion end_{};
};

}  // namespace articula
