// SPDX-License-Identifier: Apache-2.0
/// @file Many runs of an experiment, in threads. Needs the CMake target articula::sweep (oneTBB,
/// Boost).
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/sweep/run_chunk.hpp"
#include "articula/sweep/sweep_options.hpp"
#include "articula/sweep/sweep_result.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace articula {

namespace detail {

/// Adds the runs of a chunk to a result, and calls the hooks.
/// @return  false if the hooks end the sweep
template <class Hooks>
[[nodiscard]] bool collect(const ComputedChunk& chunk, SweepResult& result, const Hooks& hooks) {
  for (const SweepRow& row : chunk.rows) {
    result.add(row);
    if (hooks.row) hooks.row(row);
  }
  if (hooks.lines) hooks.lines(chunk.lines);
  return !hooks.progress || hooks.progress(result);
}

/// Refuses a result with more runs than its sweep has.
inline void check_begun(const SweepResult& result, const Samples& samples) {
  if (result.runs() <= samples.runs()) return;
  refuse(
      {"sweep: the result has ", result.runs(), " runs already, and the sweep ", samples.runs()});
}

}  // namespace detail

/// What to do while a sweep runs. Calls come from one thread at a time, in the order of the runs.
struct SweepHooks {
  std::function<void(const SweepRow&)> row{};  ///< with each run
  /// With some runs as lines of CSV, see append_row. The threads and ranks that compute the runs
  /// write their lines, too.
  std::function<void(std::string_view)> lines{};
  /// After some runs, with all so far; false ends the sweep early.
  std::function<bool(const SweepResult&)> progress{};
};

/// Goes on with a sweep, from the first run that the result does not have. All threads take chunks
/// of runs; memory does not grow with the number of runs.
/// @param result  of the runs so far; gets the others
/// @throws std::invalid_argument if an option is out of range; std::runtime_error if the
///         experiment throws; and what the hooks throw
/// Real-time: no (allocates, throws).
template <SweepExperiment E>
void continue_sweep(const E& experiment, const SweepOptions& options, SweepResult& result,
                    const SweepHooks& hooks = {}) {
  const Samples samples(experiment.parameters(), options.sampling);
  validate(options, result.metrics());
  detail::check_begun(result, samples);
  std::optional<tbb::global_control> more_threads;  // than processors, if that is asked for
  if (options.threads > 0) {
    more_threads.emplace(tbb::global_control::max_allowed_parallelism,
                         static_cast<std::size_t>(options.threads));
  }
  tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
  arena.initialize();
  const auto under_way = 4 * static_cast<std::size_t>(arena.max_concurrency());
  std::uint64_t next = result.runs();
  std::atomic<bool> goes_on = true;
  const bool with_lines = hooks.lines != nullptr;
  const auto take = [&](tbb::flow_control& flow) {
    const SweepChunk chunk{next, std::min(options.chunk, samples.runs() - next)};
    if (chunk.count == 0 || !goes_on) flow.stop();
    next += chunk.count;
    return chunk;
  };
  const auto compute = [&](const SweepChunk& chunk) {
    if (chunk.count == 0) return ComputedChunk();
    return compute_chunk(experiment, samples, chunk, with_lines);
  };
  const auto collect = [&](const ComputedChunk& chunk) {
    if (goes_on && !chunk.rows.empty()) goes_on = detail::collect(chunk, result, hooks);
  };
  arena.execute([&] {
    tbb::parallel_pipeline(
        under_way,
        tbb::make_filter<void, SweepChunk>(tbb::filter_mode::serial_in_order, take) &
            tbb::make_filter<SweepChunk, ComputedChunk>(tbb::filter_mode::parallel, compute) &
            tbb::make_filter<ComputedChunk, void>(tbb::filter_mode::serial_in_order, collect));
  });
}

/// Runs an experiment many times with other parameters, and summarises:
///
///     const SweepResult result = sweep(experiment, {.sampling = {.runs = 10'000}});
///     result.summary("elbow_active_joint.overshoot").quantile(0.95);
///
/// The result has the same bits for any number of threads and any chunk. A run that becomes
/// unstable or not finite, or cannot be simulated, is counted, see SweepResult::runs_with.
/// @param experiment  for example a ClosedLoopExperiment
/// @throws as continue_sweep
/// Real-time: no (allocates, throws).
template <SweepExperiment E>
[[nodiscard]] SweepResult sweep(const E& experiment, const SweepOptions& options = {},
                                const SweepHooks& hooks = {}) {
  SweepResult result(experiment.metrics(), options);
  continue_sweep(experiment, options, result, hooks);
  return result;
}

}  // namespace articula
