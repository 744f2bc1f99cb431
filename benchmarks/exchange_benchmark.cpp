// SPDX-License-Identifier: Apache-2.0
// What exchange with other threads, recording and supervision cost the loop. One thread: these are
// the instructions, without the other side's cache traffic. Beside them the usual way with a mutex.
#include <articula/articula.hpp>
#include <articula/loop/duration_histogram.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/robots/q2d.hpp>

#include <benchmark/benchmark.h>

#include <memory>
#include <mutex>

namespace {

using namespace articula;
using Reference = JointReference<6>;
using Record = CycleRecord<6, EffortCommand<6>>;

void empty_body(benchmark::State& bench) {
  Reference reference;
  for (auto _ : bench) {
    ++reference.position[0];
    benchmark::DoNotOptimize(reference);
  }
}

void latest_value_write(benchmark::State& bench) {
  auto latest = std::make_unique<LatestValue<Reference>>();
  Reference reference;
  for (auto _ : bench) {
    ++reference.position[0];
    latest->write(reference);
    benchmark::ClobberMemory();
  }
}

void latest_value_write_and_update(benchmark::State& bench) {
  auto latest = std::make_unique<LatestValue<Reference>>();
  Reference reference;
  for (auto _ : bench) {
    ++reference.position[0];
    latest->write(reference);
    bool updated = latest->update();
    benchmark::DoNotOptimize(updated);
    benchmark::DoNotOptimize(&latest->value());
    benchmark::ClobberMemory();
  }
}

void latest_value_nothing_new(benchmark::State& bench) {
  auto latest = std::make_unique<LatestValue<Reference>>();
  for (auto _ : bench) {
    bool updated = latest->update();
    benchmark::DoNotOptimize(updated);
  }
}

void mutex_write_and_read(benchmark::State& bench) {
  std::mutex mutex;
  Reference shared, reference, mine;
  for (auto _ : bench) {
    ++reference.position[0];
    {
      const std::lock_guard lock(mutex);
      shared = reference;
    }
    {
      const std::lock_guard lock(mutex);
      mine = shared;
    }
    benchmark::DoNotOptimize(mine);
  }
}

void event_ring_push_and_pop(benchmark::State& bench) {
  auto ring = std::make_unique<EventRing<Reference, 64>>();
  Reference reference, taken;
  for (auto _ : bench) {
    ++reference.position[0];
    ring->push(reference);
    bool popped = ring->pop(taken);
    benchmark::DoNotOptimize(popped);
    benchmark::DoNotOptimize(taken);
  }
}

void recorder_add(benchmark::State& bench) {
  auto recorder = std::make_unique<Recorder<Record, 10000>>();
  Record record;
  for (auto _ : bench) {
    ++record.cycle;
    recorder->add(record);
    benchmark::ClobberMemory();
  }
}

void histogram_add(benchmark::State& bench) {
  DurationHistogram histogram;
  std::chrono::nanoseconds duration(1000);
  for (auto _ : bench) {
    duration += std::chrono::nanoseconds(17);
    histogram.add(duration);
    benchmark::ClobberMemory();
  }
}

void clock_reading(benchmark::State& bench) {
  const MonotonicClock clock;
  for (auto _ : bench) {
    auto now = clock.now();
    benchmark::DoNotOptimize(now);
  }
}

void cycle_alone(benchmark::State& bench) {
  Loop<Q2dSim, PidPlusGravity> loop;
  for (auto _ : bench) {
    Status status = loop.update();
    benchmark::DoNotOptimize(status);
  }
}

void cycle_supervised(benchmark::State& bench) {
  SupervisedLoop<Q2dSim, PidPlusGravity> loop;
  loop.request_activation();
  for (auto _ : bench) {
    Status status = loop.update();
    benchmark::DoNotOptimize(status);
  }
}

BENCHMARK(empty_body);
BENCHMARK(latest_value_write);
BENCHMARK(latest_value_write_and_update);
BENCHMARK(latest_value_nothing_new);
BENCHMARK(mutex_write_and_read);
BENCHMARK(event_ring_push_and_pop);
BENCHMARK(recorder_add);
BENCHMARK(histogram_add);
BENCHMARK(clock_reading);
BENCHMARK(cycle_alone);
BENCHMARK(cycle_supervised);

}  // namespace
