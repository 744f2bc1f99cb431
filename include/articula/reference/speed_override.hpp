// SPDX-License-Identifier: Apache-2.0
/// @file A clock that makes a motion slower or faster while it runs.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// A clock that slows down, stops and speeds up a motion while it runs. With the speed f, the
/// motion's own time s and the reference r(s),
///
///     ds/dt = f,  position r,  velocity f r',  acceleration f^2 r'' + (df/dt) r'.
///
/// f changes to the requested speed at a bounded rate, so that velocities do not jump.
///
///     override.advance(loop.period());
///     loop.reference() = override.apply(waves.sample(override.time()));
class SpeedOverride {
 public:
  /// @param rate     |df/dt| while f changes [1/s]
  /// @param highest  highest f [1], at least 1; above 1 the joints can exceed the motion's limits
  /// @throws std::invalid_argument if the rate is not between 1e-9 and 1e9, or the highest speed is
  ///         not between 1 and 1e9
  explicit SpeedOverride(double rate = 2, double highest = 1) : rate_(rate), highest_(highest) {
    if (!is_finite(rate) || rate < 1e-9 || rate > 1e9) {
      detail::refuse({"speed override: rate ", rate, " 1/s is not between 1e-9 and 1e9"});
    }
    if (!is_finite(highest) || highest < 1 || highest > 1e9) {
      detail::refuse({"speed override: highest speed ", highest, " is not between 1 and 1e9"});
    }
  }

  /// Requests a speed, clamped to the highest one: 1 is the motion as planned, 0 a pause. A
  /// negative number, and one that is not finite, is a pause. Real-time: yes.
  void set(double speed) noexcept {
    target_ = is_finite(speed) ? std::clamp(speed, 0.0, highest_) : 0.0;
  }

  /// Takes the requested speed at once: for a motion that has not begun. Real-time: yes.
  void settle() noexcept {
    speed_ = target_;
    slope_ = 0;
  }

  /// Moves on by a period.
  /// @param period  [s]; ignored unless finite and positive
  /// Real-time: yes.
  void advance(double period) noexcept {
    if (!is_finite(period) || period <= 0) return;
    const double change = target_ - speed_;
    const double changing = std::min(period, std::abs(change) / rate_);
    slope_ = changing < period ? 0 : std::copysign(rate_, change);
    const double before = speed_;
    speed_ = changing < period ? target_ : speed_ + slope_ * period;
    time_ += changing * (before + speed_) / 2 + (period - changing) * speed_;
  }

  /// s, the motion's own time [s]. Real-time: yes.
  [[nodiscard]] double time() const noexcept { return time_; }
  /// Sets the motion's own time [s]. Real-time: yes.
  void restart(double time) noexcept { time_ = time; }
  /// The present f [1]. Real-time: yes.
  [[nodiscard]] double speed() const noexcept { return speed_; }

  /// Converts a reference from the motion's own time to real time. Real-time: yes.
  template <int N>
  [[nodiscard]] JointReference<N> apply(JointReference<N> reference) const noexcept {
    for (int j = 0; j < N; ++j) {
      double &v = reference.velocity[j], &a = reference.acceleration[j];
      a = speed_ * speed_ * a + slope_ * v;
      v *= speed_;
    }
    return reference;
  }

  /// Converts a reference from real time to the motion's own time. At speed 0, velocity and
  /// acceleration become 0. Real-time: yes.
  template <int N>
  [[nodiscard]] JointReference<N> unapply(JointReference<N> reference) const noexcept {
    for (int j = 0; j < N; ++j) {
      double &v = reference.velocity[j], &a = reference.acceleration[j];
      v = speed_ > 0 ? v / speed_ : 0;
      a = speed_ > 0 ? (a - slope_ * v) / (speed_ * speed_) : 0;
    }
    return reference;
  }

 private:
  double rate_;
  double highest_;
  double target_ = 1;
  double speed_ = 1;
  double slope_ = 0;  ///< df/dt
  double time_ = 0;
};

}  // namespace articula
