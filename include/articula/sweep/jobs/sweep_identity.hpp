// SPDX-License-Identifier: Apache-2.0
/// @file What tells one sweep from another.
#pragma once

#include "articula/sweep/row_text.hpp"
#include "articula/sweep/run_chunk.hpp"
#include "articula/sweep/sampling/samples.hpp"
#include "articula/sweep/sweep_experiment.hpp"
#include "articula/sweep/sweep_options.hpp"
#include "articula/sweep/sweep_result.hpp"
#include "articula/text/numbers.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// FNV-1a (Fowler, Noll, Vo).
[[nodiscard]] inline std::uint64_t hash_of_text(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// A hash of the parameters, the metrics and the options of a sweep.
/// @param own  text of the caller
template <SweepExperiment E>
[[nodiscard]] std::uint64_t hash_of_options(const E& experiment, const SweepOptions& options,
                                            std::string_view own) {
  std::string text(own);
  const auto add = [&](const auto&... parts) { ((text += '\n', text += parts), ...); };
  for (const SweepParameter& p : experiment.parameters()) {
    add(p.name, number_text(p.low), number_text(p.high), std::to_string(int(p.spacing)),
        std::to_string(p.levels));
  }
  for (const SweepMetric& metric : experiment.metrics()) add(metric.name);
  const Sampling& sampling = options.sampling;
  add(std::to_string(int(sampling.method)), std::to_string(sampling.runs),
      std::to_string(sampling.seed), options.worst_metric, std::to_string(options.worst));
  for (const SweepSpecification& each : options.specifications) {
    add(each.metric, number_text(each.highest));
  }
  return hash_of_text(text);
}

/// A word for the same sweep: the hash of its options, '-', and that of its first rows. These show
/// the robot, the gains and the bits of the program.
/// @param own  text of the caller
/// @throws as run_chunk
template <SweepExperiment E>
[[nodiscard]] std::string identity_of(const E& experiment, const SweepOptions& options,
                                      std::string_view own) {
  constexpr std::uint64_t shown_runs = 4;
  std::string rows;
  const Samples samples(experiment.parameters(), options.sampling);
  for (const SweepRow& row :
       run_chunk(experiment, samples, {0, std::min(shown_runs, samples.runs())})) {
    append_row(rows, row);
  }
  return std::to_string(hash_of_options(experiment, options, own)) + "-" +
         std::to_string(hash_of_text(rows));
}

}  // namespace articula::detail
