// SPDX-License-Identifier: Apache-2.0
// What a Remote costs the loop: the same cycles with and without it, nobody asking, the rings
// emptied by another thread's part in between, whose time is not counted.
#include <articula/articula.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <memory>

namespace {

using namespace articula;

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using PlainQ2d = Loop<Q2dSim, PidPlusGravity>;
using SupervisedQ2d = SupervisedLoop<Q2dSim, PidPlusGravity>;
using SwitchedQ2d = SupervisedLoop<Q2dSim, Controllers>;
using SupervisedPanda = SupervisedLoop<Simulator<Panda>, ComputedTorque>;

template <class LoopType>
void activate(LoopType& loop, auto& runs) {
  if constexpr (requires { loop.request_activation(); }) loop.request_activation();
  for (int k = 0; k < 10; ++k) static_cast<void>(runs.update());
}

template <class LoopType>
void cycle_alone(benchmark::State& bench) {
  auto loop = std::make_unique<LoopType>();
  activate(*loop, *loop);
  for (auto _ : bench) {
    if constexpr (requires { loop->request_activation(); }) loop->post(loop->reference());
    Status status = loop->update();
    benchmark::DoNotOptimize(status);
  }
}

/// Batches of cycles that the rings hold; the rings are emptied between them.
template <class LoopType>
void cycle_with_remote(benchmark::State& bench) {
  auto loop = std::make_unique<LoopType>();
  Remote remote(*loop);
  activate(*loop, remote);
  std::size_t cycles = 0;
  RunReport report;
  for (auto _ : bench) {
    Status status = remote.update();
    remote.report(report);
    benchmark::DoNotOptimize(status);
    if (++cycles % 512 == 0) {
      bench.PauseTiming();
      static_cast<void>(remote.statistics());
      bench.ResumeTiming();
    }
  }
  bench.counters["dropped"] = static_cast<double>(remote.statistics().dropped);
}

BENCHMARK(cycle_alone<PlainQ2d>)->Name("cycle_alone/Q2d_plain");
BENCHMARK(cycle_with_remote<PlainQ2d>)->Name("cycle_with_remote/Q2d_plain");
BENCHMARK(cycle_alone<SupervisedQ2d>)->Name("cycle_alone/Q2d_supervised");
BENCHMARK(cycle_with_remote<SupervisedQ2d>)->Name("cycle_with_remote/Q2d_supervised");
BENCHMARK(cycle_alone<SwitchedQ2d>)->Name("cycle_alone/Q2d_switched");
BENCHMARK(cycle_with_remote<SwitchedQ2d>)->Name("cycle_with_remote/Q2d_switched");
BENCHMARK(cycle_alone<SupervisedPanda>)->Name("cycle_alone/Panda_supervised");
BENCHMARK(cycle_with_remote<SupervisedPanda>)->Name("cycle_with_remote/Panda_supervised");

}  // namespace
