// SPDX-License-Identifier: Apache-2.0
/// @file The report of a run.
#pragma once

#include "articula/core/status.hpp"
#include "articula/loop/duration_histogram.hpp"

#include <chrono>
#include <cstdint>
#include <string_view>

namespace articula {

/// Why a run ended.
enum class RunEnd : unsigned char {
  running,   ///< It has not ended.
  finished,  ///< All cycles that were asked for are done.
  stopped,   ///< The stop flag was raised.
  declined,  ///< The function that is called after each cycle did not want another.
  overruns,  ///< As many cycles as the options allow have overrun.
};

/// The end of a run in words.
/// Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(RunEnd end) noexcept {
  switch (end) {
    case RunEnd::running:
      return "running";
    case RunEnd::finished:
      return "finished";
    case RunEnd::stopped:
      return "stopped";
    case RunEnd::declined:
      return "declined";
    case RunEnd::overruns:
      return "overruns";
  }
  return "unknown end";
}

/// When one cycle took place.
struct CycleTiming {
  std::chrono::nanoseconds latency{0};  ///< from when it was due to its start
  std::chrono::nanoseconds period{0};   ///< from the start before to its start; 0 for the first
  std::chrono::nanoseconds update{0};   ///< what the loop's update took
};

/// What has happened since a run began. It has a fixed size (24 kB) and is kept without allocating.
struct RunReport {
  RunEnd end = RunEnd::running;
  Status status = Status::ok;  ///< of the last update
  std::uint64_t cycles = 0;    ///< updates that were made
  std::uint64_t overruns = 0;  ///< cycles that ended after the next one was due
  std::uint64_t missed = 0;    ///< whole periods without an update, of all overruns together
  CycleTiming timing{};        ///< of the last cycle
  DurationHistogram latency{};
  DurationHistogram period{};
  DurationHistogram execution{};  ///< update and the function that is called after it
};

}  // namespace articula
