// SPDX-License-Identifier: Apache-2.0
/// @file The runs of a sweep, summarised: quantiles and the worst runs.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/sim/simulation_end.hpp"
#include "articula/sweep/statistics/metric_summary.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/sweep/sweep_options.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace articula {

/// One run: what it was and what it measured. Its parameters and its seed replay it.
struct SweepRow {
  std::uint64_t number = 0;
  std::uint64_t seed = 0;
  std::vector<double> parameters{};
  std::vector<double> metrics{};
  SimulationEnd end = SimulationEnd::stable;

  /// The run that an experiment repeats. It refers to this row's parameters.
  [[nodiscard]] SweepRun run() const noexcept { return {number, seed, parameters}; }
};

/// A sweep's runs, summarised. Its size does not grow with their number. Rows are added in the
/// order of their numbers.
class SweepResult {
 public:
  /// A result without runs.
  /// @throws std::invalid_argument if an option is out of range or names no metric
  SweepResult(std::vector<SweepMetric> metrics, const SweepOptions& options)
      : metrics_(std::move(metrics)), summaries_(metrics_.size()), worst_size_(options.worst) {
    validate(options, metrics_);
    if (!options.worst_metric.empty()) {
      worst_metric_ = detail::metric_index(metrics_, options.worst_metric);
    }
    for (const SweepSpecification& each : options.specifications) {
      limits_.emplace_back(detail::metric_index(metrics_, each.metric), each.highest);
    }
  }

  /// Adds a run. Real-time: no (allocates).
  void add(const SweepRow& row) {
    ++runs_;
    ++ends_[static_cast<std::size_t>(row.end)];
    for (std::size_t k = 0; k < summaries_.size(); ++k) summaries_[k].add(row.metrics[k]);
    if (meets_all(row)) ++within_;
    keep_if_worst(row);
  }

  [[nodiscard]] const std::vector<SweepMetric>& metrics() const noexcept { return metrics_; }
  /// Number of runs so far.
  [[nodiscard]] std::uint64_t runs() const noexcept { return runs_; }
  /// Number of runs with this end.
  [[nodiscard]] std::uint64_t runs_with(SimulationEnd end) const noexcept {
    return ends_[static_cast<std::size_t>(end)];
  }
  /// Numbers of runs, in the order of SimulationEnd.
  [[nodiscard]] const auto& ends() const noexcept { return ends_; }
  /// Number of stable runs that meet all specifications.
  [[nodiscard]] std::uint64_t runs_within() const noexcept { return within_; }
  /// One metric over all runs.
  /// @throws std::invalid_argument if there is no such metric
  [[nodiscard]] const MetricSummary& summary(std::string_view metric) const {
    return summaries_[detail::metric_index(metrics_, metric)];
  }
  [[nodiscard]] const std::vector<MetricSummary>& summaries() const noexcept { return summaries_; }
  /// One metric of one run.
  /// @throws std::invalid_argument if there is no such metric
  [[nodiscard]] double metric(const SweepRow& row, std::string_view name) const {
    return row.metrics[detail::metric_index(metrics_, name)];
  }
  /// The worst runs, the worst one first: those in which the metric is undefined, then those in
  /// which it is largest. Of equal ones, those with the lowest numbers.
  [[nodiscard]] const std::vector<SweepRow>& worst() const noexcept { return worst_; }

  /// True if a run is stable and meets all specifications.
  [[nodiscard]] bool meets_all(const SweepRow& row) const noexcept {
    return row.end == SimulationEnd::stable &&
           std::all_of(limits_.begin(), limits_.end(),
                       [&](const auto& limit) { return row.metrics[limit.first] <= limit.second; });
  }

  /// The counts of a part of a sweep, from a file.
  void restore(std::uint64_t within,
               const std::array<std::uint64_t, simulation_end_names.size()>& ends,
               std::vector<MetricSummary> summaries, std::vector<SweepRow> worst) {
    within_ = within;
    ends_ = ends;
    runs_ = std::accumulate(ends.begin(), ends.end(), std::uint64_t{0});
    summaries_ = std::move(summaries);
    worst_ = std::move(worst);
  }

 private:
  [[nodiscard]] bool is_worse(const SweepRow& a, const SweepRow& b) const noexcept {
    const auto badness = [&](const SweepRow& row) {
      const double value = row.metrics[worst_metric_];
      return is_finite(value) ? value : std::numeric_limits<double>::infinity();
    };
    const double first = badness(a), second = badness(b);
    return first != second ? first > second : a.number < b.number;
  }
  void keep_if_worst(const SweepRow& row) {
    if (worst_.size() == worst_size_) {
      if (worst_.empty() || !is_worse(row, worst_.back())) return;
      worst_.pop_back();
    }
    const auto place =
        std::upper_bound(worst_.begin(), worst_.end(), row,
                         [this](const SweepRow& a, const SweepRow& b) { return is_worse(a, b); });
    worst_.insert(place, row);
  }

  std::vector<SweepMetric> metrics_;
  std::vector<MetricSummary> summaries_;
  std::vector<std::pair<std::size_t, double>> limits_{};  ///< metric and its highest value
  std::size_t worst_metric_ = 0, worst_size_ = 0;
  std::vector<SweepRow> worst_{};
  std::array<std::uint64_t, simulation_end_names.size()> ends_{};
  std::uint64_t runs_ = 0, within_ = 0;
};

}  // namespace articula
