// SPDX-License-Identifier: Apache-2.0
/// @file Runs a loop in real time. Linux.
#pragma once

#include "articula/loop/monotonic_clock.hpp"
#include "articula/loop/realtime_thread.hpp"
#include "articula/loop/run.hpp"

#include <utility>

namespace articula {

/// How a loop runs in real time.
///
///     run(loop, {.thread = {.priority = 99, .processors = {1}}, .run = {.stop = &stop}});
struct RealtimeOptions {
  ThreadOptions thread{};
  RunOptions run{};
};

/// Makes the calling thread fit for real time and runs the loop on it by CLOCK_MONOTONIC; see
/// make_realtime and the other `run`.
/// @throws std::invalid_argument if an option or the loop's period makes no sense
/// @throws std::system_error if the system refuses, unless options.thread.warn takes the refusal
/// Real-time: all cycles, if update and each are.
template <RunnableLoop LoopType, class Each = WhileOk>
RunReport run(LoopType& loop, const RealtimeOptions& options, Each each = {}) {
  make_realtime(options.thread);
  MonotonicClock clock;
  return run(loop, clock, options.run, std::move(each));
}

}  // namespace articula
