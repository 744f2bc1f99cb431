// SPDX-License-Identifier: Apache-2.0
/// @file What a call takes in a control loop that sleeps until its next cycle.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

/// Measures calls each of which comes after a millisecond of sleep. Meanwhile the processor
/// forgets: caches and branch predictors are used by others, and the clock may be lowered. The
/// median and the 99th percentile are counters, [ns]; the time of reading the clock is in them and
/// in the case `clock/after_sleep`.
/// @param work  takes the number of the call
template <class Work>
void measure_after_sleep(benchmark::State& bench, const Work& work) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds period(1);
  std::vector<double> nanoseconds;
  std::size_t call = 0;
  auto wake = Clock::now();
  for (auto _ : bench) {
    wake += period;
    std::this_thread::sleep_until(wake);
    const auto begin = Clock::now();
    work(call++);
    const auto end = Clock::now();
    if (end > wake + period) wake = end;
    const std::chrono::duration<double> seconds = end - begin;
    bench.SetIterationTime(seconds.count());
    nanoseconds.push_back(1e9 * seconds.count());
  }
  std::sort(nanoseconds.begin(), nanoseconds.end());
  bench.counters["p50_ns"] = nanoseconds[nanoseconds.size() / 2];
  bench.counters["p99_ns"] = nanoseconds[nanoseconds.size() * 99 / 100];
}

/// A case of this kind: `<name>/after_sleep`, of a second.
template <class Work>
void register_after_sleep(const std::string& name, const Work& work) {
  benchmark::RegisterBenchmark(
      (name + "/after_sleep").c_str(),
      [work](benchmark::State& bench) { measure_after_sleep(bench, work); })
      ->UseManualTime()
      ->Iterations(1000);
}
