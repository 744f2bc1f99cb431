// SPDX-License-Identifier: Apache-2.0
// The fan of futures that the view draws while a gain is typed: a second of a hundred Q2D at 1 kHz.
#include <articula/articula.hpp>
#include <articula/futures/futures.hpp>
#include <articula/robots/q2d.hpp>

#include <benchmark/benchmark.h>

namespace {

using namespace articula;

void hundred_futures(benchmark::State& bench) {
  FutureStart<EffortCommand<2>> start;
  start.reference.position << 0.3, -0.2;
  const PidPlusGravity<Q2d> controller;
  for (auto _ : bench) {
    auto fan = futures(Q2d(), controller, start, {});
    benchmark::DoNotOptimize(fan);
  }
}

}  // namespace

BENCHMARK(hundred_futures)->Unit(benchmark::kMillisecond);
