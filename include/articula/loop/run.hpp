// SPDX-License-Identifier: Apache-2.0
/// @file Runs a loop on a clock.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/core/status.hpp"
#include "articula/loop/loop_clock.hpp"
#include "articula/loop/run_report.hpp"
#include "articula/loop/stop.hpp"
#include "articula/loop/stop_flag.hpp"

#include <chrono>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

namespace articula {

/// What can be run: a Loop, a SupervisedLoop or your own.
template <class L>
concept RunnableLoop = requires(L loop) {
  { loop.update() } noexcept -> std::same_as<Status>;
  { loop.period() } -> std::convertible_to<double>;
};

/// When a run ends. The default is never, unless a cycle goes wrong.
struct RunOptions {
  static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

  std::uint64_t cycles = unlimited;    ///< updates to make
  std::uint64_t overruns = unlimited;  ///< the run ends with the overrun of this number
  const StopFlag* stop = nullptr;      ///< ends the run at the next cycle once it is raised
};

/// What `run` does after each cycle by default: goes on as long as all is well.
struct WhileOk {
  template <class LoopType>
  [[nodiscard]] bool operator()(const LoopType&, const RunReport& report) const noexcept {
    return report.status == Status::ok;
  }
};

/// Runs a loop, one update per period, until an option, the stop flag or `each` ends it; then stops
/// it (see stop.hpp).
///
/// Updates are due on a grid: one period after another from the first on, whatever the updates
/// take, so that no delay adds up. A cycle that ends after the next one was due is an overrun. The
/// periods that it has used up are skipped, and the grid stays. Their number is passed to
/// `missed_periods(count)` of the loop, if it has that function.
/// @param loop     what to run
/// @param clock    what paces it
/// @param options  when to end
/// @param each     called as `each(loop, report)` after each update, within the cycle: for setting
///                 references, recording and deciding whether to go on (returns bool). It must be
///                 fit for real time.
/// @return         what happened
/// @throws std::invalid_argument if the loop's period is not between 1 ns and 1000 s
/// Real-time: all cycles, if update, each and the clock are.
template <RunnableLoop LoopType, LoopClock Clock, class Each = WhileOk>
  requires std::predicate<Each&, LoopType&, const RunReport&>
RunReport run(LoopType& loop, Clock& clock, const RunOptions& options = {}, Each each = {}) {
  using std::chrono::nanoseconds;
  const double seconds = loop.period();
  if (!is_finite(seconds) || seconds < 1e-9 || seconds > 1000) {
    detail::refuse({"run: period ", seconds, " s is not between 1e-9 s and 1000 s"});
  }
  const nanoseconds period(std::llround(seconds * 1e9));

  RunReport report;
  const auto miss = [&](std::uint64_t periods) {
    if (periods == 0) return;
    report.missed += periods;
    if constexpr (requires { loop.missed_periods(periods); }) loop.missed_periods(periods);
  };
  try {
    nanoseconds expected = clock.now() + period;
    nanoseconds last_start{};
    while (report.end == RunEnd::running) {
      const nanoseconds due = clock.wait_until(expected);
      if (options.stop != nullptr && options.stop->requested()) {
        report.end = RunEnd::stopped;
        break;
      }
      // A pace that is not the clock's own may leave cycles out.
      if (due - expected > period / 2) {
        miss(static_cast<std::uint64_t>((due - expected + period / 2) / period));
      }

      const nanoseconds start = clock.now();
      report.timing.latency = start - due;
      report.timing.period = report.cycles > 0 ? start - last_start : nanoseconds(0);
      last_start = start;
      report.status = loop.update();
      report.timing.update = clock.now() - start;
      ++report.cycles;
      report.latency.add(report.timing.latency);
      if (report.cycles > 1) report.period.add(report.timing.period);
      const bool go_on = each(loop, static_cast<const RunReport&>(report));
      const nanoseconds end = clock.now();
      report.execution.add(end - start);

      expected = due + period;
      if (end > expected) {
        const auto skipped = (end - expected + period - nanoseconds(1)) / period;
        expected += skipped * period;
        ++report.overruns;
        miss(static_cast<std::uint64_t>(skipped));
      }
      if (!go_on) {
        report.end = RunEnd::declined;
      } else if (report.cycles >= options.cycles) {
        report.end = RunEnd::finished;
      } else if (report.overruns >= options.overruns) {
        report.end = RunEnd::overruns;
      }
    }
  } catch (...) {  // from `each`: the robot must not keep the last command
    static_cast<void>(stop(loop, report.status));
    throw;
  }
  const Status stopped = stop(loop, report.status);
  if (report.status == Status::ok) report.status = stopped;
  return report;
}

}  // namespace articula
