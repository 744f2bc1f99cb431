// SPDX-License-Identifier: Apache-2.0
/// @file Metrics of a step response: rise time, overshoot, settling time, steady error.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace articula {

/// Measures the motion of one joint from `start` to `target`:
///
///     StepMetrics metrics(0, 0.5);
///     while (...) metrics.add(loop.time(), loop.state().position[0]);
///     if (metrics.overshoot() > 0.1) ...
///
/// An undefined metric is empty. All are undefined without a step, without a sample, or after a sample
/// that is not finite or earlier than the one before. Between samples the response is interpolated
/// linearly.
class StepMetrics {
 public:
  /// @param start   position before the step [rad or m]
  /// @param target  reference from the first sample on [rad or m]
  /// @param band    of the settling time, a share of the step in either direction [1], > 0, < 1
  /// @throws std::invalid_argument naming the parameter and its value, if one is not finite, the
  ///         step overflows, or the band is out of range
  /// Real-time: no (throws).
  StepMetrics(double start, double target, double band = 0.02)
      : start_(start), height_(target - start), band_(band) {
    if (!is_finite(height_)) {
      detail::refuse({"step metrics: from ", start, " to ", target, " is no finite step"});
    }
    if (!(band > 0 && band < 1)) {
      detail::refuse({"step metrics: band ", band, " is not between 0 and 1"});
    }
  }

  /// Adds a sample. The first one is at the time of the step.
  /// @param time      [s], not less than that of the sample before
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

  /// Time from first reaching 10 % of the step to first reaching 90 % [s]. Empty: 90 % not reached.
  [[nodiscard]] std::optional<double> rise_time() const noexcept {
    return defined(high_time_ - low_time_, arrived());
  }

  /// The largest distance beyond the target, as a share of the step. Empty: 90 % not reached.
  [[nodiscard]] std::optional<double> overshoot() const noexcept {
    return defined(std::max(0.0, highest_ - 1), arrived());
  }

  /// The position farthest in the direction of the step [rad or m].
  [[nodiscard]] std::optional<double> peak() const noexcept {
    return defined(start_ + height_ * highest_, begun());
  }

  /// Time from the step to the peak [s].
  [[nodiscard]] std::optional<double> peak_time() const noexcept {
    return defined(highest_time_ - step_time_, highest_ > 0);
  }

  /// Time from the step until the position stays within the band around the target [s]. Empty: the
  /// last sample is outside.
  [[nodiscard]] std::optional<double> settling_time() const noexcept {
    return defined(settled_time_ - step_time_, settled_time_ != never);
  }

  /// Target minus position at the last sample [rad or m].
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

  /// The time at which the straight line from a to b reaches a level between them.
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
