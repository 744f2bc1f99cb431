// SPDX-License-Identifier: Apache-2.0
/// @file An experiment without a loop, for what a sweep does beside the runs.
#pragma once

#include <articula/sweep/sweep_experiment.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace articula {

/// Its rows are as long as those of a Q2D whose two joints step, with four parameters.
struct PlainRows {
  static constexpr std::size_t metric_count = 19;

  [[nodiscard]] std::vector<SweepParameter> parameters() const {
    return {{"a", "1", 0, 1}, {"b", "1", 0, 1}, {"c", "1", 0, 1}, {"d", "1", 0, 1}};
  }
  [[nodiscard]] std::vector<SweepMetric> metrics() const {
    std::vector<SweepMetric> all;
    for (std::size_t k = 0; k < metric_count; ++k) all.push_back({std::to_string(k), "1"});
    return all;
  }
  [[nodiscard]] SimulationEnd run(const SweepRun& run, std::span<double> metrics) const {
    for (std::size_t k = 0; k < metrics.size(); ++k) {
      metrics[k] = std::exp(run.parameters[k % 4] * static_cast<double>(k + 1));
    }
    return SimulationEnd::stable;
  }
};

}  // namespace articula
