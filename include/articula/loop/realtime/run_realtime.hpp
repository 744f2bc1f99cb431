// SPDX-License-Identifier: Apache-2.0
/// @file Runs a loop on a real-time thread. Linux.
#pragma once

#include "articula/core/hardware.hpp"
#include "articula/loop/realtime/hardware_clock.hpp"
#include "articula/loop/realtime/monotonic_clock.hpp"
#include "articula/loop/realtime/realtime_thread.hpp"
#include "articula/loop/run.hpp"

#include <string>
#include <type_traits>
#include <utility>

namespace articula {

/// Settings of the thread and of the run.
///
///     run(loop, {.thread = {.priority = 99, .processors = {1}}, .run = {.stop = &stop}});
struct RealtimeOptions {
  ThreadOptions thread{};
  RunOptions run{};
};

/// Prepares the calling thread with make_realtime and runs the loop on it, as the other `run` does.
/// Passes the loop's notices to options.thread.warn. The hardware paces the loop if it can
/// (HardwareClock), else CLOCK_MONOTONIC does.
/// @throws std::invalid_argument if an option or the loop's period is out of range
/// @throws std::system_error if the system refuses a setting and options.thread is strict
/// Real-time: all cycles, if update and each are.
template <RunnableLoop LoopType, class Each = WhileOk>
RunReport run(LoopType& loop, const RealtimeOptions& options, Each each = {}) {
  make_realtime(options.thread);
  if constexpr (requires { loop.notices(); }) {
    for (const std::string& notice : loop.notices()) {
      if (options.thread.warn) options.thread.warn(notice);
    }
  }
  MonotonicClock clock;
  if constexpr (requires { HardwareClock(loop.hardware(), clock, loop.period()); }) {
    HardwareClock pace(loop.hardware(), clock, loop.period());
    return run(loop, pace, options.run, std::move(each));
  } else {
    return run(loop, clock, options.run, std::move(each));
  }
}

}  // namespace articula
