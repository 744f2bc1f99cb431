// SPDX-License-Identifier: Apache-2.0
/// @file What engineers say of a step response: rise time, overshoot, settling time.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace articula::examples {

/// Follows one joint from `start` to `target` and measures how it gets there. A metric is empty
/// where it is undefined: all of them if there is no step. Between two samples the response is
/// taken as a straight line.
class StepMetrics {
 public:
  /// @param start   position before the step [rad]
  /// @param target  position asked for from the first sample on [rad]
  StepMetrics(double start, double target) : start_(start), height_(target - start) {}

  /// The next sample; the first one is taken at the moment of the step.
  /// @param time      [s], growing from sample to sample
  /// @param position  [rad]
  void add(double time, double position) {
    if (height_ == 0) return;
    const Sample now{time, (position - start_) / height_};
    if (step_time_ == never) {
      step_time_ = time;
      last_ = now;
    }
    if (low_time_ == never && now.share >= low) low_time_ = crossing(last_, now, low);
    if (high_time_ == never && now.share >= high) high_time_ = crossing(last_, now, high);
    highest_ = std::max(highest_, now.share);
    if (std::abs(now.share - 1) > band) {
      settled_time_ = never;
    } else if (settled_time_ == never) {
      settled_time_ = crossing(last_, now, last_.share < 1 ? 1 - band : 1 + band);
    }
    last_ = now;
  }

  /// Time from first reaching 10 % of the step to first reaching 90 % [s]. Empty: never there.
  [[nodiscard]] std::optional<double> rise_time() const {
    if (high_time_ == never) return {};
    return high_time_ - low_time_;
  }

  /// How far it went beyond the target at most, as a share of the step. Empty: never reached 90 %,
  /// where an overshoot of 0 would praise a joint that does not move.
  [[nodiscard]] std::optional<double> overshoot() const {
    if (high_time_ == never) return {};
    return std::max(0.0, highest_ - 1);
  }

  /// Time from the step until the position stays within 2 % of the step around the target [s].
  /// Empty: it is not there at the last sample.
  [[nodiscard]] std::optional<double> settling_time() const {
    if (settled_time_ == never) return {};
    return settled_time_ - step_time_;
  }

 private:
  static constexpr double low = 0.1, high = 0.9, band = 0.02;               // shares of the step
  static constexpr double never = std::numeric_limits<double>::infinity();  // [s]

  struct Sample {
    double time;   ///< [s]
    double share;  ///< of the step: 0 at its start, 1 at its target
  };

  /// When the straight line from a to b reaches a level that lies between them.
  [[nodiscard]] static double crossing(const Sample& a, const Sample& b, double level) {
    if (a.share == b.share) return b.time;
    return std::lerp(a.time, b.time, (level - a.share) / (b.share - a.share));
  }

  double start_;
  double height_;
  double highest_ = 0;
  Sample last_{};
  double step_time_ = never;
  double low_time_ = never;
  double high_time_ = never;
  double settled_time_ = never;
};

}  // namespace articula::examples
