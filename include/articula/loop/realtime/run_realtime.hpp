// SPDX-License-Identifier: Apache-2.0
/// @file Runs a loop in real time. Linux.
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

/// How a loop runs in real time.
///
///     run(loop, {.thread = {.priority = 99, .processors = {1}}, .run = {.stop = &stop}});
struct RealtimeOptions {
  ThreadOptions thread{};
  RunOptions run{};
};

/// A loop whose hardware can pace it.
template <class L>
concept PacedLoop =
    requires(L loop) { requires PacingHardware<std::remove_cvref_t<decltype(loop.hardware())>>; };

/// Makes the calling thread fit for real time and runs the loop on it; see make_realtime and the
/// other `run`. What the loop has to say before (its notices) goes to options.thread.warn. The pace is that of the loop's hardware where it can give one (see HardwareClock),
/// else CLOCK_MONOTONIC.
/// @throws std::invalid_argument if an option or the loop's period makes no sense
/// @throws std::system_error if the system refuses and options.thread is strict; else it is a
///         warning, see ThreadOptions
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
  if constexpr (PacedLoop<LoopType>) {
    HardwareClock pace(loop.hardware(), clock, loop.period());
    return run(loop, pace, options.run, std::move(each));
  } else {
    return run(loop, clock, options.run, std::move(each));
  }
}

}  // namespace articula
