// SPDX-License-Identifier: Apache-2.0
/// @file The interface of an experiment, which a sweep runs many times.
#pragma once

#include "articula/sim/simulation_end.hpp"
#include "articula/sweep/sampling/sweep_parameter.hpp"

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace articula {

/// A number that each run measures. Larger is worse.
struct SweepMetric {
  std::string name{};
  std::string unit{};  ///< "1" if it has none
};

/// One run of a sweep.
struct SweepRun {
  std::uint64_t number = 0;              ///< from 0
  std::uint64_t seed = 0;                ///< of all in it that is random
  std::span<const double> parameters{};  ///< a value for each parameter
};

/// Something that a sweep runs many times:
///
/// - `parameters()` are the numbers that vary, `metrics()` what each run measures.
/// - `run(run, metrics)` runs once, fills in the metrics, and returns how the run has ended.
///   Metrics that are not finite are undefined in this run. Several threads call it at the same
///   time. The result depends on the run alone. What it throws ends the sweep.
///
/// If there is `run_together(std::span<SweepRow>)`, a sweep calls it with some rows that have
/// number, seed and parameters. It gives each what `run` gives, to the last bit.
///
/// ClosedLoopExperiment is a robot under a controller.
template <class E>
concept SweepExperiment =
    requires(const E& experiment, const SweepRun& run, std::span<double> metrics) {
      { experiment.parameters() } -> std::convertible_to<std::vector<SweepParameter>>;
      { experiment.metrics() } -> std::convertible_to<std::vector<SweepMetric>>;
      { experiment.run(run, metrics) } -> std::same_as<SimulationEnd>;
    };

}  // namespace articula
