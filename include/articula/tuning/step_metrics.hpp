// SPDX-License-Identifier: Apache-2.0
/// @file What engineers say of a step response: rise time, overshoot, settling time, what remains.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace articula {

/// Follows one joint from `start` to `target` and measures how it gets there:
///
///     StepMetrics metrics(0, 0.5);
///     while (...) metrics.add(loop.time(), loop.state().position[0]);
///     if (metrics.overshoot() > 0.1) ...
///
/// A metric is empty where it is undefined: all of them if there is no step, no sample, or a sample
/// that is not finite or earlier than the one before. Between two samples the response is taken as
/// a straight line.
class StepMetrics {
 public:
  /// @param start   position before the step [rad or m]
  /// @param target  position asked for from the first sample on [rad or m]
  /// @param band    of the settling time, a share of the step in either direction [1], within 0 ..
  ///                1
  /// @throws std::invalid_argument naming the parameter and its value, if one is not finite, the
  ///         step overflows, or the band is not between 0 and 1
  /// Real-time: no (throws).
  StepMetrics(double start, double target, double band = 0.02)
      : start_(start), height_(target - start), band_(band) {
    if (!is_finite(height_)) {
      detail::refuse({"step metrics: from ", start, " to ", target, " is not a finite step"});
    }
    if (!(band > 0 && band < 1)) {
      detail::refuse({"step metrics: band ", band, " is not within 0 .. 1"});
    }
  }

  /// The next sample; the first one is taken at the moment of the step.
  /// @param time      [s], growing from sample to sample
  /// @param position  [rad or m]
  /// Real-time: yes.
  void add(double time, double position) noexcept {
    if (height_ == 0 || broken_) return;
    const Sample now{time, (position - start_) / height_};
    broken_ = !is_finite(now.time) || !is_finite(now.share) || (begun() && time < last_.time);
    if (broken_) return;
    if (!begun()) {
      step_time_ = time;
      last_ = now;
    }
    if (low_time_ == never && now.share >= low) low_time_ = crossing(last_, now, low);
    if (high_time_ == never && now.share >= high) high_time_ = crossing(last_, now, high);
    if (now.share > highest_) {
      highest_ = now.share;
      highest_time_ = time;
    }
    if (std::abs(now.share - 1) > band_) {
      settled_time_ = never;
    } else if (settled_time_ == never) {
      settled_time_ = crossing(last_, now, last_.share < 1 ? 1 - band_ : 1 + band_);
    }
    last_ = now;
  }

  /// Time from first reaching 10 % of the step to first reaching 90 % [s]. Empty: never there.
  [[nodiscard]] std::optional<double> rise_time() const noexcept {
    return defined(high_time_ - low_time_, arrived());
  }

  /// How far it went beyond the target at most, as a share of the step. Empty: never reached 90 %,
  /// where an overshoot of 0 would praise a joint that does not move.
  [[nodiscard]] std::optional<double> overshoot() const noexcept {
    return defined(std::max(0.0, highest_ - 1), arrived());
  }

  /// The furthest position on the way of the step and beyond [rad or m].
  [[nodiscard]] std::optional<double> peak() const noexcept {
    return defined(start_ + height_ * highest_, begun());
  }

  /// When it was there first, counted from the step [s].
  [[nodiscard]] std::optional<double> peak_time() const noexcept {
    return defined(highest_time_ - step_time_, highest_ > 0);
  }

  /// Time from the step until the position stays within the band around the target [s]. Empty: it
  /// is not there at the last sample.
  [[nodiscard]] std::optional<double> settling_time() const noexcept {
    return defined(settled_time_ - step_time_, settled_time_ != never);
  }

  /// What remains of the step at the last sample, target minus position [rad or m].
  [[nodiscard]] std::optional<double> steady_error() const noexcept {
    return defined(height_ * (1 - last_.share), begun());
  }

 private:
  static constexpr double low = 0.1, high = 0.9;                       // shares of the step
  static constexpr double never = std::numeric_limits<double>::max();  // [s]

  struct Sample {
    double time;   ///< [s]
    double share;  ///< of the step: 0 at its start, 1 at its target
  };

  /// When the straight line from a to b reaches a level that lies between them.
  [[nodiscard]] static double crossing(const Sample& a, const Sample& b, double level) noexcept {
    if (a.share == b.share) return b.time;
    return std::lerp(a.time, b.time, (level - a.share) / (b.share - a.share));
  }

  [[nodiscard]] bool begun() const noexcept { return step_time_ != never; }
  [[nodiscard]] bool arrived() const noexcept { return high_time_ != never; }
  [[nodiscard]] std::optional<double> defined(double value, bool is_known) const noexcept {
    if (broken_ || !is_known) return {};
    return value;
  }

  double start_;
  double height_;
  double band_;
  bool broken_ = false;
  double highest_ = 0;
  double highest_time_ = 0;
  Sample last_{};
  double step_time_ = never;
  double low_time_ = never;
  double high_time_ = never;
  double settled_time_ = never;
};

}  // namespace articula
