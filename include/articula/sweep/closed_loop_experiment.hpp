// SPDX-License-Identifier: Apache-2.0
/// @file A robot under a controller, to be run many times with other parameters.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/futures/futures.hpp"
#include "articula/loop/control_loop.hpp"
#include "articula/reference/joint_signals.hpp"
#include "articula/sim/simulator.hpp"
#include "articula/sweep/delayed_commands.hpp"
#include "articula/sweep/run_measures.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/sweep/varied_loop.hpp"

#include <array>
#include <cmath>
#include <cstddef>
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

/// A closed loop for `sweep`: a ControlLoop of a simulated robot that differs from run to run, and a
/// controller that knows the described robot.
///
///     const ClosedLoopExperiment experiment(
///         Q2d(), Q2d::pid_gains,
///         [](const JointPidGains<2>& gains) { return PidPlusGravity<Q2d>(gains); },
///         {.target = JointVector<2>(0.5, -0.5),
///          .vary = {{VariedQuantity::mass, "elbow_passive_link", 0.8, 1.2}}});
///
/// `loop(run)` gives everything that a run differs in.
/// @tparam R     the robot as described
/// @tparam Make  makes the controller of gains; several threads call it at the same time
template <DynamicRobot R, class Make>
class ClosedLoopExperiment {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Gains = JointPidGains<joint_count>;
  using Controller = std::remove_cvref_t<std::invoke_result_t<const Make&, const Gains&>>;

  /// @param gains  nominal
  /// @throws std::invalid_argument naming the option, link or joint, value and limit: also if a loop
  ///         with all parameters at their low or high ends cannot be simulated
  ClosedLoopExperiment(R robot, const Gains& gains, Make make,
                       ClosedLoopOptions<joint_count> options)
      : robot_(std::move(robot)), make_(std::move(make)), options_(std::move(options)) {
    nominal_.model = model_of(robot_);
    nominal_.gains = gains;
    nominal_.simulation = options_.simulation;
    validate(robot_, options_.simulation);
    nominal_.simulation.initial_position = initial_position(robot_, options_.simulation);
    target_ = options_.target.value_or(*nominal_.simulation.initial_position);
    constexpr double most_cycles = 1e6;
    const double period = options_.simulation.period;
    if (!(options_.duration >= period && options_.duration <= most_cycles * period)) {
      detail::refuse({"sweep: duration ", options_.duration, " s is not within ", period, " .. ",
                      most_cycles * period});
    }
    cycles_ = static_cast<int>(std::lround(options_.duration / period));
    for (const JointSignal& signal : options_.disturbances) {
      if (signal.target == SignalTarget::effort) continue;
      detail::refuse({"sweep: the disturbance of joint '", signal.joint.view(), "' is no effort"});
    }
    signals_.emplace(robot_, options_.signals, JointReference<joint_count>{target_});
    disturbances_.emplace(robot_, options_.disturbances,
                          JointReference<joint_count>{*nominal_.simulation.initial_position});
    for (const Variation& each : options_.vary) {
      varied_.push_back(detail::placed(robot_, each));
      parameters_.push_back(each.parameter());
    }
    for (int j = 0; j < joint_count; ++j) {
      moves_[static_cast<std::size_t>(j)] =
          target_[j] != (*nominal_.simulation.initial_position)[j];
    }
    metrics_ = RunMeasures<joint_count>::metrics(joint_names(robot_), moves_);
    standard_metrics_ = metrics_.size();
    for (const auto& own : options_.own_metrics) {
      if (!own.next) detail::refuse({"sweep: metric '", own.metric.name, "' has no function"});
      metrics_.push_back(own.metric);
    }
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

  /// One run. It ends early if the motion or a command is not finite; metrics are of the time until
  /// then.
  /// @throws std::invalid_argument if the loop cannot be simulated
  /// Real-time: no (allocates).
  [[nodiscard]] FutureEnd run(const SweepRun& run, std::span<double> metrics) const {
    using Simulated = Simulator<typename VariedLoop<R>::Model>;
    using Command = typename detail::CheckedController<Controller, joint_count, double>::Command;
    const VariedLoop<R> own = loop(run);
    ControlLoop arm(
        DelayedCommands<Simulated, Command>(Simulated(own.model, own.simulation), own.delay),
        make_(own.gains));
    Simulated& simulator = arm.hardware().simulator();
    RunMeasures<joint_count> measures(simulator.true_state().position, target_);
    std::vector<double> own_values(options_.own_metrics.size());
    detail::LimitSwings<joint_count> swings(effort_limits(own.model));
    FutureEnd end = FutureEnd::stable;
    for (int cycle = 0; cycle <= cycles_; ++cycle) {
      const double time = cycle * arm.period();
      arm.reference() = signals_->sample(time);
      const JointState<joint_count>& truth = simulator.true_state();
      if (!is_finite(truth)) {
        end = FutureEnd::non_finite;
        break;
      }
      measures.add(time, truth, arm.reference(), arm.period());
      for (std::size_t k = 0; k < own_values.size(); ++k) {
        own_values[k] = options_.own_metrics[k].next(own_values[k], truth, arm.reference());
      }
      if (cycle == cycles_) break;
      if (!options_.disturbances.empty()) {
        simulator.set_external_effort(disturbances_->sample(time).effort);
      }
      if (arm.update() != Status::ok) {
        end = FutureEnd::non_finite;
        break;
      }
      if (4 * cycle >= 3 * cycles_) swings.note(simulator.true_state().effort);
    }
    if (end == FutureEnd::stable && swings.many()) end = FutureEnd::unstable;
    measures.values(moves_, metrics.first(standard_metrics_));
    std::copy(own_values.begin(), own_values.end(),
              metrics.begin() + std::ptrdiff_t(standard_metrics_));
    return end;
  }

 private:
  /// Sets up a loop at the ends of all ranges.
  void check_ends() const {
    for (const double share : {0.0, 1.0}) {
      std::vector<double> values;
      for (const SweepParameter& parameter : parameters_) values.push_back(parameter.value(share));
      const VariedLoop<R> own = loop({0, 1, values});
      try {
        validate(own.model, own.simulation);
        static_cast<void>(make_(own.gains));
      } catch (const std::invalid_argument& error) {
        detail::refuse({"sweep: with all parameters at their ", share == 0 ? "low" : "high",
                        " ends: ", error.what()});
      }
    }
  }

  R robot_;
  Make make_;
  ClosedLoopOptions<joint_count> options_;
  VariedLoop<R> nominal_{};
  JointVector<joint_count> target_;
  int cycles_ = 0;
  std::optional<JointSignals<R>> signals_{}, disturbances_{};
  std::vector<detail::PlacedVariation> varied_{};
  std::vector<SweepParameter> parameters_{};
  std::array<bool, static_cast<std::size_t>(joint_count)> moves_{};
  std::vector<SweepMetric> metrics_{};
  std::size_t standard_metrics_ = 0;
};

}  // namespace articula
