// SPDX-License-Identifier: Apache-2.0
/// @file One metric over all runs of a sweep.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/sweep/statistics/exact_sum.hpp"
#include "articula/sweep/statistics/quantile_sketch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace articula {

/// A metric over many runs: extremes, mean and quantiles. A metric that is not finite is undefined
/// in this run, such as the settling time of a joint that does not settle. Summaries of parts merge
/// to the summary of all, with the same bits in any order.
struct MetricSummary {
  std::uint64_t undefined = 0;  ///< runs in which it is not finite
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  ExactSum sum{};
  QuantileSketch sketch{};

  /// Real-time: no (allocates).
  void add(double value) {
    if (!is_finite(value)) {
      ++undefined;
      return;
    }
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
    sum.add(value);
    sketch.add(value);
  }
  /// Real-time: no (allocates).
  void merge(const MetricSummary& other) {
    undefined += other.undefined;
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
    sum.merge(other.sum);
    sketch.merge(other.sketch);
  }

  /// The mean of the runs in which it is defined; NaN if there is none.
  [[nodiscard]] double mean() const noexcept {
    return sum.value() / static_cast<double>(sketch.count());
  }
  /// The value that a share of all runs does not exceed, with the sketch's accuracy. Undefined
  /// values count as above all others: a quantile among them is infinite. NaN without a run.
  /// @param share  0 .. 1
  /// @throws std::invalid_argument if the share is out of range
  [[nodiscard]] double quantile(double share) const {
    if (!(share >= 0 && share <= 1)) {
      detail::refuse({"sweep: quantile ", share, " is not within 0 .. 1"});
    }
    const std::uint64_t all = sketch.count() + undefined;
    if (all == 0) return std::nan("");
    const auto rank = static_cast<std::uint64_t>(share * static_cast<double>(all - 1));
    if (rank >= sketch.count()) return std::numeric_limits<double>::infinity();
    if (rank == 0) return lowest;
    if (rank + 1 == sketch.count()) return highest;
    return std::clamp(sketch.at_rank(rank), lowest, highest);
  }
};

}  // namespace articula
