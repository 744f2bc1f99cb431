// SPDX-License-Identifier: Apache-2.0
/// @file Consecutive runs of a sweep.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/sweep/row_text.hpp"
#include "articula/sweep/sampling/samples.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/sweep/sweep_result.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace articula {

/// Runs of consecutive numbers.
struct SweepChunk {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// The runs of a chunk.
struct ComputedChunk {
  std::vector<SweepRow> rows{};
  std::string lines{};  ///< the same as CSV, if a sweep's hooks ask for it
};

namespace detail {

/// A row with what decides a run.
[[nodiscard]] inline SweepRow row_of(const Samples& samples, std::uint64_t number,
                                     std::size_t metrics) {
  SweepRow row{.number = number,
               .seed = samples.seed(number),
               .parameters = std::vector<double>(samples.parameters().size()),
               .metrics = std::vector<double>(metrics, std::nan(""))};
  samples.values(number, row.parameters);
  return row;
}

}  // namespace detail

/// One run of a sweep, for example to replay one of the worst.
/// @throws std::runtime_error naming the run and its parameters, if the experiment throws
/// Real-time: no (allocates).
template <SweepExperiment E>
[[nodiscard]] SweepRow run_once(const E& experiment, const Samples& samples, std::uint64_t number) {
  SweepRow row = detail::row_of(samples, number, experiment.metrics().size());
  try {
    row.end = experiment.run(row.run(), row.metrics);
  } catch (const std::exception& error) {
    std::string values;
    for (std::size_t p = 0; p < row.parameters.size(); ++p) {
      values += detail::message_of(
          {p == 0 ? "" : ", ", samples.parameters()[p].name, " ", row.parameters[p]});
    }
    throw std::runtime_error(
        detail::message_of({"sweep: run ", number, " (", values, "): ", error.what()}));
  }
  return row;
}

/// The runs of a chunk: together if the experiment can, else one after the other.
/// @throws std::runtime_error naming the run or the runs, if the experiment throws
/// Real-time: no (allocates).
template <SweepExperiment E>
[[nodiscard]] std::vector<SweepRow> run_chunk(const E& experiment, const Samples& samples,
                                              const SweepChunk& chunk) {
  std::vector<SweepRow> rows;
  rows.reserve(chunk.count);
  if constexpr (requires(std::span<SweepRow> all) { experiment.run_together(all); }) {
    const std::size_t metrics = experiment.metrics().size();
    for (std::uint64_t k = 0; k < chunk.count; ++k) {
      rows.push_back(detail::row_of(samples, chunk.first + k, metrics));
    }
    try {
      experiment.run_together(rows);
    } catch (const std::exception& error) {
      throw std::runtime_error(
          detail::message_of({"sweep: runs ", chunk.first, " .. ", chunk.first + chunk.count - 1,
                              ": ", error.what()}));
    }
  } else {
    for (std::uint64_t k = 0; k < chunk.count; ++k) {
      rows.push_back(run_once(experiment, samples, chunk.first + k));
    }
  }
  return rows;
}

/// The runs of a chunk, and their lines of CSV.
/// @param with_lines  false: without the lines
/// @throws std::runtime_error as above
/// Real-time: no (allocates).
template <SweepExperiment E>
[[nodiscard]] ComputedChunk compute_chunk(const E& experiment, const Samples& samples,
                                          const SweepChunk& chunk, bool with_lines) {
  ComputedChunk computed{run_chunk(experiment, samples, chunk)};
  if (with_lines) {
    for (const SweepRow& row : computed.rows) append_row(computed.lines, row);
  }
  return computed;
}

}  // namespace articula
