// SPDX-License-Identifier: Apache-2.0
/// @file The metrics of one simulated run, and whether it ended stable, unstable or not finite.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/scalar.hpp"
#include "articula/futures/limit_swings.hpp"
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

/// The settings that all runs of an experiment share: length, target, signals, metrics.
template <DynamicRobot R>
struct RunPlan {
  static constexpr int joint_count = articula::joint_count<R>;

  int cycles = 0;
  double period = 0;                                   ///< [s]
  JointVector<joint_count> target{};                   ///< [rad or m]
  std::array<bool, std::size_t{joint_count}> moves{};  ///< joints that make a step
  std::optional<JointSignals<R>> signals{};            ///< added to the target
  bool has_signals = false;                            ///< so the reference changes
  std::optional<JointSignals<R>> disturbances{};       ///< none: no efforts
  std::vector<OwnMetric<joint_count>> own_metrics{};
  std::size_t standard_metrics = 0;  ///< those before the own ones

  [[nodiscard]] double time(int cycle) const noexcept { return cycle * period; }
  [[nodiscard]] bool is_last_quarter(int cycle) const noexcept { return 4 * cycle >= 3 * cycles; }
};

/// Computes the metrics of one run while it is simulated, or of the runs in the lanes of a pack.
/// Each run gets a fresh one:
///
///     RunWatch<R> watch(plan, start, effort_limits(robot));
///     watch.begin(cycle, state, reference);       // before each cycle, and after the last one
///     watch.finish(cycle, state);                 // after each cycle
///     const SimulationEnd end = watch.result(metrics);
///
/// It stores no states, so its memory does not grow with the run. For single runs whose states you
/// want to see, use a Recorder.
/// @tparam S  double, or a pack
template <DynamicRobot R, class S = double>
class RunWatch {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using State = JointState<joint_count, S>;
  using Reference = JointReference<joint_count>;
  using Mask = MaskOf<S>;

  /// @param plan    must outlive the watch
  /// @param start   positions at time 0 [rad or m]
  /// @param limits  effort limits [N m or N]
  RunWatch(const RunPlan<R>& plan, const JointVector<joint_count, S>& start,
           const JointVector<joint_count, S>& limits)
      : plan_(&plan),
        measures_(start, plan.target, plan.moves),
        own_values_(static_cast<std::size_t>(lanes<S>) * plan.own_metrics.size()),
        swings_(limits) {}

  /// Adds the state to the metrics, at the beginning of a cycle and after the last one.
  /// @param goes_on  the runs that have not ended
  /// @return         the runs whose motion is finite; the others have ended
  [[nodiscard]] Mask begin(int cycle, const State& truth, const Reference& reference,
                           const Mask& goes_on = mask_of<S>(true)) {
    const Mask good = goes_on & is_finite(truth);
    fail(goes_on & not_of(good));
    if (!any_of(good)) return good;
    measures_.add(plan_->time(cycle), truth, reference, plan_->period);
    for (int k = 0; k < lanes<S> && !own_values_.empty(); ++k) {
      if (is_true(good, k)) add_own(k, lane_of(truth, k), reference);
    }
    return good;
  }
  /// Adds the efforts of the drives in a cycle, from which unstable runs are recognised.
  void finish(int cycle, const State& truth) noexcept {
    if (plan_->is_last_quarter(cycle)) swings_.note(truth.effort);
  }
  /// Ends these runs: one of their numbers is not finite.
  void fail(const Mask& runs) noexcept { non_finite_ = non_finite_ | runs; }

  /// @param metrics  receives all metrics. They are NaN for a run that was not finite, since those
  ///                 of its few cycles would look good.
  [[nodiscard]] SimulationEnd result(std::span<double> metrics, int lane = 0) const {
    if (is_true(non_finite_, lane)) {
      std::ranges::fill(metrics, std::numeric_limits<double>::quiet_NaN());
      return SimulationEnd::non_finite;
    }
    measures_.values(metrics.first(plan_->standard_metrics), lane);
    for (std::size_t k = 0; k < plan_->own_metrics.size(); ++k) {
      metrics[plan_->standard_metrics + k] = own_values_[place(lane, k)];
    }
    return is_true(swings_.many(), lane) ? SimulationEnd::unstable : SimulationEnd::stable;
  }

 private:
  [[nodiscard]] std::size_t place(int lane, std::size_t metric) const noexcept {
    return static_cast<std::size_t>(lane) * plan_->own_metrics.size() + metric;
  }
  void add_own(int lane, const JointState<joint_count>& truth, const Reference& reference) {
    for (std::size_t k = 0; k < plan_->own_metrics.size(); ++k) {
      double& value = own_values_[place(lane, k)];
      value = plan_->own_metrics[k].next(value, truth, reference);
    }
  }

  const RunPlan<R>* plan_;
  RunMeasures<joint_count, S> measures_;
  std::vector<double> own_values_;  ///< lane by lane
  LimitSwings<joint_count, S> swings_;
  Mask non_finite_ = mask_of<S>(false);
};

}  // namespace articula::detail
