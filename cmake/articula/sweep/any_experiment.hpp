// SPDX-License-Identifier: Apache-2.0
/// @file The closed loop of a sweep from a file. `sweep --compile` compiles this header, too.
#pragma once

#include <articula/config/load_pid_gains.hpp>
#include <articula/config/yaml/source.hpp>
#include <articula/reference/joint_signals.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/sweep_experiment.hpp>
#include <articula/sweep/sweep_result.hpp>
#include <articula/sweep/variation/variation.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace terminal {

/// What a file says about a closed loop and its experiment.
struct SweptLoop {
  articula::ConfigSource controllers;  ///< file of gains
  std::string section{};               ///< of the controller in it
  double period = 1e-3;                ///< [s]
  int substeps = 1;
  double duration = 1;                              ///< [s]
  std::map<std::string, double> start{}, target{};  ///< by joint [rad or m]
  std::vector<articula::JointSignal> disturbances{};
  std::vector<articula::Variation> vary{};
};

/// An experiment whose robot is not part of its type.
struct AnyExperiment {
  std::vector<articula::SweepParameter> all_parameters{};
  std::vector<articula::SweepMetric> all_metrics{};
  std::function<articula::SimulationEnd(const articula::SweepRun&, std::span<double>)> run_one{};
  std::function<void(std::span<articula::SweepRow>)> run_some{};
  std::vector<std::string> notes{};  ///< of the gains' file

  [[nodiscard]] const std::vector<articula::SweepParameter>& parameters() const {
    return all_parameters;
  }
  [[nodiscard]] const std::vector<articula::SweepMetric>& metrics() const { return all_metrics; }
  [[nodiscard]] articula::SimulationEnd run(const articula::SweepRun& run,
                                            std::span<double> metrics) const {
    return run_one(run, metrics);
  }
  void run_together(std::span<articula::SweepRow> rows) const { run_some(rows); }
};

/// What the program and a compiled library must agree on: the sizes of what they exchange.
inline constexpr auto interface_sizes = std::to_array<std::size_t>(
    {sizeof(SweptLoop), sizeof(AnyExperiment), sizeof(articula::SweepRow),
     sizeof(articula::SweepRun), sizeof(articula::SweepParameter), sizeof(articula::SweepMetric),
     sizeof(articula::Variation), sizeof(articula::JointSignal), sizeof(articula::ConfigSource)});

/// The experiment of a robot under the controller that a function makes of gains.
/// @throws articula::FileError, std::invalid_argument
template <articula::DynamicRobot R, class Make>
[[nodiscard]] AnyExperiment any_experiment(const R& robot, const Make& make,
                                           const SweptLoop& loop) {
  constexpr int n = articula::joint_count<R>;
  articula::ClosedLoopOptions<n> options;
  options.simulation.period = loop.period;
  options.simulation.substeps = loop.substeps;
  options.duration = loop.duration;
  options.disturbances = loop.disturbances;
  options.vary = loop.vary;
  const auto with = [&](articula::JointVector<n> positions, const auto& named) {
    for (const auto& [joint, position] : named) {
      positions[articula::joint_index(robot, articula::Name(joint))] = position;
    }
    return positions;
  };
  const articula::JointVector<n> start =
      with(articula::initial_position(robot, options.simulation), loop.start);
  options.simulation.initial_position = start;
  options.target = with(start, loop.target);
  const auto loaded = articula::load_pid_gains(robot, loop.controllers, loop.section);
  using Experiment = articula::ClosedLoopExperiment<R, Make>;
  const auto experiment =
      std::make_shared<const Experiment>(robot, loaded.gains, make, std::move(options));
  return {experiment->parameters(), experiment->metrics(),
          [experiment](const articula::SweepRun& run, std::span<double> metrics) {
            return experiment->run(run, metrics);
          },
          [experiment](std::span<articula::SweepRow> rows) { experiment->run_together(rows); },
          loaded.notes};
}

}  // namespace terminal
