// SPDX-License-Identifier: Apache-2.0
/// @file A robot under a controller, to be run many times with other parameters.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/loop/loop_parts.hpp"
#include "articula/reference/joint_signals.hpp"
#include "articula/sim/simulation_end.hpp"
#include "articula/sim/simulator_options.hpp"
#include "articula/sweep/lane_runs.hpp"
#include "articula/sweep/loop_refused.hpp"
#include "articula/sweep/run_simulated.hpp"
#include "articula/sweep/run_watch.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/sweep/sweep_result.hpp"
#include "articula/sweep/variation/varied_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula {

/// What happens in each run, what varies and what is measured.
template <int N>
struct ClosedLoopOptions {
  SimulatorOptions<N> simulation{};  ///< nominal; its seed is not used
  double duration = 1;               ///< of a run, at least a period, at most 1 000 000 periods [s]
  std::optional<JointVector<N>> target{};   ///< step at time 0; none: the initial position
  std::vector<JointSignal> signals{};       ///< added to the target
  std::vector<JointSignal> disturbances{};  ///< efforts on the joints; their target is effort
  std::vector<Variation> vary{};            ///< what varies
  std::vector<OwnMetric<N>> own_metrics{};  ///< beside those of RunMeasures
};

/// A closed loop for `sweep`: a ControlLoop of a simulated robot that differs from run to run, and
/// a controller that knows the described robot.
///
///     const ClosedLoopExperiment experiment(
///         Q2d(), Q2d::pid_gains,
///         [](const JointPidGains<2>& gains) { return PidPlusGravity<Q2d>(gains); },
///         {.target = JointVector<2>(0.5, -0.5),
///          .vary = {{VariedQuantity::mass, "elbow_passive_link", 0.8, 1.2}}});
/// @tparam R     the robot as described
/// @tparam Make  makes the controller of gains; several threads call it at the same time
template <DynamicRobot R, class Make>
class ClosedLoopExperiment {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Gains = JointPidGains<joint_count>;
  static_assert(std::is_invocable_v<const Make&, const Gains&>,
                "The function that makes the controller must take const JointPidGains<N>&, N being "
                "the number of joints.");
  using Controller = std::remove_cvref_t<std::invoke_result_t<const Make&, const Gains&>>;

  /// @param gains  nominal
  /// @throws std::invalid_argument naming the option, link or joint, value and limit
  /// @throws std::invalid_argument likewise if a loop with all parameters at their low or high ends
  ///         cannot be simulated
  ClosedLoopExperiment(R robot, const Gains& gains, Make make,
                       ClosedLoopOptions<joint_count> options)
      : robot_(std::move(robot)), make_(std::move(make)), options_(std::move(options)) {
    nominal_.model = model_of(robot_);
    nominal_.gains = gains;
    nominal_.simulation = options_.simulation;
    validate(robot_, options_.simulation);
    nominal_.simulation.initial_position = initial_position(robot_, options_.simulation);
    const JointVector<joint_count>& start = *nominal_.simulation.initial_position;
    plan_.target = options_.target.value_or(start);
    constexpr double most_cycles = 1e6;
    const double period = options_.simulation.period;
    if (!(options_.duration >= period && options_.duration <= most_cycles * period)) {
      detail::refuse({"sweep: duration ", options_.duration, " s is not within ", period, " .. ",
                      most_cycles * period});
    }
    plan_.period = period;
    plan_.cycles = static_cast<int>(std::lround(options_.duration / period));
    for (const JointSignal& signal : options_.disturbances) {
      if (signal.target == SignalTarget::effort) continue;
      detail::refuse({"sweep: the disturbance of joint '", signal.joint.view(), "' is no effort"});
    }
    plan_.signals.emplace(robot_, options_.signals, JointReference<joint_count>{plan_.target});
    plan_.has_signals = !options_.signals.empty();
    if (!options_.disturbances.empty()) {
      plan_.disturbances.emplace(robot_, options_.disturbances, JointReference<joint_count>{start});
    }
    for (const Variation& each : options_.vary) {
      varied_.push_back(detail::placed(robot_, each));
      detail::validate_factor(nominal_, varied_.back());
      parameters_.push_back(each.parameter());
      parameters_.back().unit = detail::unit_of(nominal_.model, varied_.back());
    }
    detail::validate_apart(varied_);
    for (int j = 0; j < joint_count; ++j) {
      plan_.moves[static_cast<std::size_t>(j)] = plan_.target[j] != start[j];
    }
    metrics_ = RunMeasures<joint_count>::metrics(nominal_.model.joints, plan_.moves);
    plan_.standard_metrics = metrics_.size();
    for (const auto& own : options_.own_metrics) {
      const std::string& name = own.metric.name;
      if (!own.next) detail::refuse({"sweep: metric '", name, "' has no function"});
      if (std::ranges::find(metrics_, name, &SweepMetric::name) != metrics_.end()) {
        detail::refuse({"sweep: there are two metrics '", name, "'"});
      }
      metrics_.push_back(own.metric);
    }
    plan_.own_metrics = options_.own_metrics;
    check_ends();
  }

  [[nodiscard]] const std::vector<SweepParameter>& parameters() const noexcept {
    return parameters_;
  }
  [[nodiscard]] const std::vector<SweepMetric>& metrics() const noexcept { return metrics_; }

  /// Everything that a run differs in. Real-time: no (allocates).
  [[nodiscard]] VariedLoop<R> loop(const SweepRun& run) const {
    return detail::varied_loop<R>(nominal_, varied_, run.parameters, run.seed);
  }

  /// One run, as a sweep runs it. It ends early if the motion or a command is not finite; then all
  /// metrics are undefined. They are likewise if the loop cannot be simulated; `run_alone` throws
  /// the reason.
  /// @throws what the own metrics throw
  /// Real-time: no (allocates).
  [[nodiscard]] SimulationEnd run(const SweepRun& run, std::span<double> metrics) const {
    try {
      const VariedLoop<R> own = detail::set_up([&] { return loop(run); });
      if constexpr (in_lanes) {
        if (own.robot) {
          const VariedLoop<R>* const only = &own;
          return detail::run_in_lanes<R>(plan_, {&only, 1}, make_).result(metrics);
        }
      }
      return run_alone(own, metrics);
    } catch (const detail::LoopRefused&) {
      return refused(metrics);
    }
  }

  /// Some runs: those that have `VariedLoop::robot`, under a controller that commands efforts, in
  /// the lanes of packs; the others one after the other. Each gives what `run` gives, to the last
  /// bit.
  /// @param rows  with number, seed and parameters; get metrics and end
  /// @throws what the own metrics throw
  /// Real-time: no (allocates).
  void run_together(std::span<SweepRow> rows) const {
    if constexpr (!in_lanes) {
      for (SweepRow& row : rows) row.end = run(row.run(), row.metrics);
    } else {
      constexpr std::size_t most = 256;  // loops in memory; more packs would gain nothing
      for (std::size_t begin = 0; begin < rows.size(); begin += most) {
        run_packs(rows.subspan(begin, std::min(most, rows.size() - begin)));
      }
    }
  }

  /// One run without lanes, to the last bit as in lanes. Where the compiler fuses multiplications
  /// and additions, metrics differ by some 1e-7 of their size.
  /// @param own  from `loop`
  /// @throws std::invalid_argument if the loop cannot be simulated
  /// Real-time: no (allocates).
  [[nodiscard]] SimulationEnd run_alone(const VariedLoop<R>& own, std::span<double> metrics) const {
    return on_robot_of(own, [&](const auto& robot) {
      return detail::run_simulated(plan_, robot, own, make_).result(metrics);
    });
  }

 private:
  /// True if runs can go into lanes.
  static constexpr bool in_lanes = detail::can_run_in_lanes<R, Controller>;

  [[nodiscard]] static SimulationEnd refused(std::span<double> metrics) {
    std::ranges::fill(metrics, std::numeric_limits<double>::quiet_NaN());
    return SimulationEnd::refused;
  }

  /// Calls a function with the robot that a run simulates.
  static auto on_robot_of(const VariedLoop<R>& own, const auto& use) {
    if constexpr (DescribedRobot<R>) {
      if (own.robot) return use(*own.robot);
    }
    return use(own.model);
  }

  /// Runs in packs, and one by one those that do not go into lanes.
  void run_packs(std::span<SweepRow> rows) const {
    std::vector<VariedLoop<R>> loops;
    std::vector<SweepRow*> of_loops;
    loops.reserve(rows.size());
    of_loops.reserve(rows.size());
    for (SweepRow& row : rows) {
      try {
        loops.push_back(detail::set_up([&] { return loop(row.run()); }));
        of_loops.push_back(&row);
        if (!loops.back().robot) row.end = run_alone(loops.back(), row.metrics);
      } catch (const detail::LoopRefused&) {
        row.end = refused(row.metrics);
      }
    }
    detail::run_in_packs<R>(
        plan_, loops, make_,
        [&](std::size_t place, const auto& watch, int lane) {
          of_loops[place]->end = watch.result(of_loops[place]->metrics, lane);
        },
        [&](std::size_t place) { of_loops[place]->end = refused(of_loops[place]->metrics); });
  }

  /// Sets up a loop at each corner of the ranges, of many parameters at the lowest and highest
  /// only. A light body and a strongly damped joint are at different ends.
  void check_ends() const {
    constexpr std::size_t most = 10;
    const std::size_t count = parameters_.size();
    const std::size_t corners = count <= most ? std::size_t{1} << count : 2;
    for (std::size_t corner = 0; corner < corners; ++corner) {
      std::vector<double> values;
      std::string names;
      for (std::size_t k = 0; k < count; ++k) {
        const SweepParameter& parameter = parameters_[k];
        values.push_back(
            parameter.value(count <= most ? double((corner >> k) & 1) : double(corner)));
        names +=
            detail::message_of({names.empty() ? "" : ", ", parameter.name, " ", values.back()});
      }
      try {
        const VariedLoop<R> own = loop({0, 1, values});
        on_robot_of(own, [&](const auto& robot) {
          static_cast<void>(detail::simulated_loop(robot, own, make_));
        });
      } catch (const std::invalid_argument& error) {
        detail::refuse({"sweep: with ", names, ": ", error.what()});
      }
    }
  }

  R robot_;
  Make make_;
  ClosedLoopOptions<joint_count> options_;
  VariedLoop<R> nominal_{};
  detail::RunPlan<R> plan_{};
  std::vector<detail::PlacedVariation> varied_{};
  std::vector<SweepParameter> parameters_{};
  std::vector<SweepMetric> metrics_{};
};

}  // namespace articula
