// SPDX-License-Identifier: Apache-2.0
/// @file Metrics of a step response: rise time, overshoot, settling time, steady error.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/core/scalar.hpp"

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
/// An undefined metric is empty. All are undefined without a step, without a sample, or after a
/// sample that is not finite or earlier than the one before. Between samples the response is
/// interpolated linearly.
/// @tparam S  type of a number: double, or a pack with the joint of several robots; the metrics are
///            those of one lane
template <class S>
class BasicStepMetrics {
 public:
  /// @param start   position before the step [rad or m]
  /// @param target  reference from the first sample on [rad or m]
  /// @param band    of the settling time, a share of the step in either direction [1], > 0, < 1
  /// @throws std::invalid_argument naming the parameter and its value, if one is not finite, the
  ///         step overflows, or the band is out of range
  /// Real-time: no (throws).
  BasicStepMetrics(const S& start, double target, double band = 0.02)
      : start_(start), height_(target - start), band_(band) {
    for (int k = 0; k < lanes<S>; ++k) {
      if (is_finite(lane_of(height_, k))) continue;
      detail::refuse(
          {"step metrics: from ", lane_of(start, k), " to ", target, " is no finite step"});
    }
    if (!(band > 0 && band < 1)) {
      detail::refuse({"step metrics: band ", band, " is not between 0 and 1"});
    }
  }

  /// Adds a sample. The first one is at the time of the step.
  /// @param time      [s], not less than that of the sample before
  /// @param position  [rad or m]
  /// Real-time: yes.
  void add(double time, const S& position) noexcept {
    using std::abs;
    const bool in_order = is_finite(time) && (!begun() || time >= last_time_);
    if (!in_order) broken_ = mask_of<S>(true);
    if (all_of(broken_)) return;
    const S share = (position - start_) / height_;  // not finite without a step
    broken_ = broken_ | not_of(is_finite(share));
    if (!begun()) {
      step_time_ = last_time_ = time;
      last_share_ = share;
    }
    const auto note_crossing = [&](const MaskOf<S>& now, S& reached, auto level) noexcept {
      if (!any_of(now)) return;
      for (int k = 0; k < lanes<S>; ++k) {
        if (!is_true(now, k)) continue;
        const Sample before{last_time_, lane_of(last_share_, k)}, after{time, lane_of(share, k)};
        set_lane(reached, k, crossing(before, after, level(before)));
      }
    };
    note_crossing((low_time_ == never) & (share >= low), low_time_,
                  [](const Sample&) noexcept { return low; });
    note_crossing((high_time_ == never) & (share >= high), high_time_,
                  [](const Sample&) noexcept { return high; });
    const MaskOf<S> higher = share > highest_;
    replace_where(higher, highest_, share);
    replace_where(higher, highest_time_, time);
    const MaskOf<S> outside = abs(share - 1) > band_;
    note_crossing(
        not_of(outside) & (settled_time_ == never), settled_time_,
        [this](const Sample& before) noexcept { return before.share < 1 ? 1 - band_ : 1 + band_; });
    replace_where(outside, settled_time_, never);
    last_time_ = time;
    last_share_ = share;
  }

  /// Time from first reaching 10 % of the step to first reaching 90 % [s]. Empty: 90 % not reached.
  [[nodiscard]] std::optional<double> rise_time(int lane = 0) const noexcept {
    return defined(high_time_ - low_time_, arrived(lane), lane);
  }

  /// The largest distance beyond the target, as a share of the step. Empty: 90 % not reached.
  [[nodiscard]] std::optional<double> overshoot(int lane = 0) const noexcept {
    const double beyond = lane_of(highest_, lane) - 1;
    return defined(std::max(0.0, beyond), arrived(lane), lane);
  }

  /// The position farthest in the direction of the step [rad or m].
  [[nodiscard]] std::optional<double> peak(int lane = 0) const noexcept {
    return defined(start_ + height_ * highest_, begun(), lane);
  }

  /// Time from the step to the peak [s].
  [[nodiscard]] std::optional<double> peak_time(int lane = 0) const noexcept {
    return defined(highest_time_ - step_time_, lane_of(highest_, lane) > 0, lane);
  }

  /// Time from the step until the position stays within the band around the target [s]. Empty: the
  /// last sample is outside.
  [[nodiscard]] std::optional<double> settling_time(int lane = 0) const noexcept {
    return defined(settled_time_ - step_time_, lane_of(settled_time_, lane) != never, lane);
  }

  /// Target minus position at the last sample [rad or m].
  [[nodiscard]] std::optional<double> steady_error(int lane = 0) const noexcept {
    return defined(height_ * (1 - last_share_), begun(), lane);
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
  [[nodiscard]] bool arrived(int lane) const noexcept { return lane_of(high_time_, lane) != never; }
  [[nodiscard]] std::optional<double> defined(const S& value, bool is_known,
                                              int lane) const noexcept {
    if (is_true(broken_, lane) || !is_known) return {};
    return lane_of(value, lane);
  }

  S start_;
  S height_;
  double band_;
  MaskOf<S> broken_ = mask_of<S>(false);
  S highest_ = 0;
  S highest_time_ = 0;
  double last_time_ = 0;
  S last_share_ = 0;
  double step_time_ = never;
  S low_time_ = never;
  S high_time_ = never;
  S settled_time_ = never;
};

/// The metrics of one robot's joint.
using StepMetrics = BasicStepMetrics<double>;

}  // namespace articula
