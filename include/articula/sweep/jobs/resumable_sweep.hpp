// SPDX-License-Identifier: Apache-2.0
/// @file A sweep with files: rows as CSV, and a checkpoint from which it goes on.
#pragma once

#include "articula/sweep/jobs/checkpoint.hpp"
#include "articula/sweep/jobs/sweep_csv.hpp"
#include "articula/sweep/jobs/sweep_identity.hpp"
#include "articula/sweep/sweep.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

/// The files of a sweep.
struct SweepFiles {
  std::filesystem::path rows{};        ///< CSV; empty: rows are not kept
  std::filesystem::path checkpoint{};  ///< empty: none
  double interval = 1;                 ///< shortest time between two checkpoints [s], >= 0
  /// What decides the rows, and the first four may not show: limits that they do not reach, or a
  /// version of the experiment. A checkpoint of another identity is refused.
  std::string identity{};
};

/// Runs the sweep that some threads or processes compute.
/// @param run  callable with (options, result, hooks), goes on with the result
/// @throws as `run`; std::runtime_error naming a file that cannot be used
template <SweepExperiment E, class Run>
[[nodiscard]] SweepResult resumable_sweep_by(const E& experiment, const SweepOptions& options,
                                             const SweepFiles& files, const SweepHooks& hooks,
                                             const Run& run) {
  SweepResult result(experiment.metrics(), options);
  std::string identity;
  if (!files.checkpoint.empty()) {
    identity = detail::identity_of(experiment, options, files.identity);
    if (auto before = read_checkpoint(files.checkpoint, result, identity)) {
      result = std::move(*before);
    }
  }
  std::optional<SweepCsv> csv;
  if (!files.rows.empty()) {
    csv.emplace(files.rows, sweep_columns(experiment.parameters(), experiment.metrics()),
                result.runs());
  }
  const auto write = [&](const SweepResult& so_far) {
    if (csv) csv->flush();  // first, so that no row of the checkpoint is missing
    if (!files.checkpoint.empty()) write_checkpoint(files.checkpoint, so_far, identity);
  };
  using Clock = std::chrono::steady_clock;
  Clock::time_point written = Clock::now();
  SweepHooks own;
  own.row = hooks.row;
  if (csv || hooks.lines) {
    own.lines = [&](std::string_view lines) {
      if (csv) csv->add_lines(lines);
      if (hooks.lines) hooks.lines(lines);
    };
  }
  own.progress = [&](const SweepResult& so_far) {
    if (Clock::now() - written >= std::chrono::duration<double>(files.interval)) {
      write(so_far);
      written = Clock::now();
    }
    return !hooks.progress || hooks.progress(so_far);
  };
  run(options, result, own);
  write(result);
  return result;
}

/// A sweep that goes on from its checkpoint: after a crash or SIGKILL, the same call computes
/// the runs that are missing. Its result and rows have the same bits as without interruption. The
/// first four runs are computed at each start: a checkpoint with other rows is refused.
/// @throws as continue_sweep; std::runtime_error naming a file that cannot be used
/// Real-time: no (writes files).
template <SweepExperiment E>
[[nodiscard]] SweepResult resumable_sweep(const E& experiment, const SweepOptions& options,
                                          const SweepFiles& files, const SweepHooks& hooks = {}) {
  return resumable_sweep_by(
      experiment, options, files, hooks,
      [&](const SweepOptions& all, SweepResult& result, const SweepHooks& each) {
        continue_sweep(experiment, all, result, each);
      });
}

}  // namespace articula
