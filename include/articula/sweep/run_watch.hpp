// SPDX-License-Identifier: Apache-2.0
/// @file What all runs of a closed loop have in common, and what is watched in each of them.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/futures/futures.hpp"
#include "articula/model/robot.hpp"
#include "articula/reference/joint_signals.hpp"
#include "articula/sweep/run_measures.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace articula::detail {

/// The same in all runs.
template <DynamicRobot R>
struct RunPlan {
  static constexpr int joint_count = articula::joint_count<R>;

  int cycles = 0;
  double period = 0;                                   ///< [s]
  JointVector<joint_count> target{};                   ///< [rad or m]
  std::array<bool, std::size_t{joint_count}> moves{};  ///< joints that make a step
  std::optional<JointSignals<R>> signals{};            ///< added to the target
  std::optional<JointSignals<R>> disturbances{};       ///< none: no efforts
  std::vector<OwnMetric<joint_count>> own_metrics{};
  std::size_t standard_metrics = 0;  ///< those before the own ones

  [[nodiscard]] double time(int cycle) const noexcept { return cycle * period; }
  [[nodiscard]] bool is_last_quarter(int cycle) const noexcept { return 4 * cycle >= 3 * cycles; }
};

/// Measures one run and notes how it ends.
template <DynamicRobot R>
class RunWatch {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param plan    must outlive the watch
  /// @param start   positions at time 0 [rad or m]
  /// @param limits  effort limits [N m or N]
  RunWatch(const RunPlan<R>& plan, const JointVector<joint_count>& start,
           const JointVector<joint_count>& limits)
      : plan_(&plan),
        measures_(start, plan.target),
        own_values_(plan.own_metrics.size()),
        swings_(limits) {}

  /// Measures at the beginning of a cycle, and after the last one.
  /// @return  false if the run has ended, since the motion is not finite
  [[nodiscard]] bool begin(int cycle, const JointState<joint_count>& truth,
                           const JointReference<joint_count>& reference) {
    if (!is_finite(truth)) return fail(), false;
    measures_.add(plan_->time(cycle), truth, reference, plan_->period);
    for (std::size_t k = 0; k < own_values_.size(); ++k) {
      own_values_[k] = plan_->own_metrics[k].next(own_values_[k], truth, reference);
    }
    return true;
  }
  /// Notes what the drives have given in a cycle.
  void finish(int cycle, const JointState<joint_count>& truth) {
    if (plan_->is_last_quarter(cycle)) swings_.note(truth.effort);
  }
  /// The run has ended since a number is not finite.
  void fail() noexcept { end_ = FutureEnd::non_finite; }

  /// @param metrics  receives all; NaN if the run was not finite: those of its short life would
  ///                 make it look good
  [[nodiscard]] FutureEnd result(std::span<double> metrics) const {
    if (end_ == FutureEnd::non_finite) {
      std::ranges::fill(metrics, std::numeric_limits<double>::quiet_NaN());
      return end_;
    }
    measures_.values(plan_->moves, metrics.first(plan_->standard_metrics));
    std::copy(own_values_.begin(), own_values_.end(),
              metrics.begin() + std::ptrdiff_t(plan_->standard_metrics));
    return end_ == FutureEnd::stable && swings_.many() ? FutureEnd::unstable : end_;
  }

 private:
  const RunPlan<R>* plan_;
  RunMeasures<joint_count> measures_;
  std::vector<double> own_values_;
  LimitSwings<joint_count> swings_;
  FutureEnd end_ = FutureEnd::stable;
};

}  // namespace articula::detail
