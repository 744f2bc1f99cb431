// SPDX-License-Identifier: Apache-2.0
/// @file The runs of a sweep, and what to keep of them.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/sweep/sampling/samples.hpp"
#include "articula/sweep/sweep_experiment.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A limit of a metric.
struct SweepSpecification {
  std::string metric{};
  double highest = 0;  ///< largest value that is accepted [unit of the metric]
};

/// The runs of a sweep, and what to keep of them.
struct SweepOptions {
  Sampling sampling{};
  std::vector<SweepSpecification> specifications{};  ///< for the share of runs that meet all
  std::string worst_metric{};  ///< by which the worst runs are kept; empty: the first metric
  std::size_t worst = 10;      ///< number of worst runs to keep, at most 10 000
  int threads = 0;             ///< at most 1024; 0: one for each processor
  std::uint64_t chunk = 64;    ///< runs that a thread takes at once, 1 .. 10 000
};

namespace detail {

/// The index of a metric.
/// @throws std::invalid_argument naming it and the metrics that there are
[[nodiscard]] inline std::size_t metric_index(const std::vector<SweepMetric>& metrics,
                                              std::string_view name) {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const SweepMetric& metric) { return metric.name == name; });
  if (found != metrics.end()) return static_cast<std::size_t>(found - metrics.begin());
  std::string all;
  for (const SweepMetric& metric : metrics) all += (all.empty() ? "" : ", ") + metric.name;
  refuse({"sweep: there is no metric '", name, "'; metrics: ", all});
}

}  // namespace detail

/// Refuses options that make no sweep. Those of sampling are checked by Samples.
/// @throws std::invalid_argument naming the option, its value and what is accepted
/// Real-time: no (throws).
inline void validate(const SweepOptions& options, const std::vector<SweepMetric>& metrics) {
  const auto check = [](std::string_view name, auto value, auto lowest, auto highest) {
    if (value >= lowest && value <= highest) return;
    detail::refuse({"sweep: ", name, " ", value, " is not within ", lowest, " .. ", highest});
  };
  if (metrics.empty()) detail::refuse({"sweep: the experiment measures nothing"});
  check("threads", options.threads, 0, 1024);
  check("chunk", options.chunk, std::uint64_t{1}, std::uint64_t{10'000});
  check("worst", options.worst, std::size_t{0}, std::size_t{10'000});
  if (!options.worst_metric.empty()) {
    static_cast<void>(detail::metric_index(metrics, options.worst_metric));
  }
  for (const SweepSpecification& each : options.specifications) {
    static_cast<void>(detail::metric_index(metrics, each.metric));
    if (!is_finite(each.highest)) {
      detail::refuse({"sweep: the limit ", each.highest, " of '", each.metric, "' is not finite"});
    }
  }
}

}  // namespace articula
