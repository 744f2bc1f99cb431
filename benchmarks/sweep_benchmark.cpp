// SPDX-License-Identifier: Apache-2.0
// Runs of a sweep of Q2Ds in one thread: in lanes, one by one, and one by one as a robot loaded at
// run time. Each run is a second at 1 kHz, with other masses, damping and gains.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/sweep.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

namespace {

using namespace articula;

template <class R>
auto experiment_of(const R& robot, double friction) {
  return ClosedLoopExperiment(
      robot, Q2d::pid_gains,
      [](const JointPidGains<2>& gains) { return PidPlusGravity<Q2d>(gains); },
      {.target = JointVector<2>(0.5, -0.5),
       .vary = {{VariedQuantity::mass, {}, 0.8, 1.2},
                {VariedQuantity::damping, {}, 0.8, 1.2},
                {VariedQuantity::added_friction, {}, 0, friction},
                {VariedQuantity::proportional, {}, 0.8, 1.2}}});
}

constexpr std::uint64_t runs = 64;

void count_runs(benchmark::State& bench) {
  bench.counters["runs_per_second"] = benchmark::Counter(
      static_cast<double>(bench.iterations()) * runs, benchmark::Counter::kIsRate);
}

/// As `sweep` runs them in each thread.
void sweep_chunks(benchmark::State& bench, const auto& experiment) {
  const Samples samples(experiment.parameters(), {.runs = runs});
  for (auto _ : bench) {
    benchmark::DoNotOptimize(run_chunk(experiment, samples, {0, runs}));
  }
  count_runs(bench);
}
template <bool Friction>
void alone(benchmark::State& bench) {
  const auto experiment = experiment_of(Q2d(), Friction ? 0.5 : 0.0);
  const Samples samples(experiment.parameters(), {.runs = runs});
  std::vector<double> metrics(experiment.metrics().size()), values(4);
  for (auto _ : bench) {
    for (std::uint64_t k = 0; k < runs; ++k) {
      samples.values(k, values);
      const auto loop = experiment.loop({k, samples.seed(k), values});
      benchmark::DoNotOptimize(experiment.run_alone(loop, metrics));
    }
  }
  count_runs(bench);
}

template <bool Friction>
void in_lanes(benchmark::State& bench) {
  sweep_chunks(bench, experiment_of(Q2d(), Friction ? 0.5 : 0.0));
  bench.counters["lanes"] = symbolic::Pack<>::lanes;
}
template <bool Friction>
void loaded(benchmark::State& bench) {
  sweep_chunks(bench, experiment_of(detail::ModelOf<Q2d>(model_of(Q2d())), Friction ? 0.5 : 0.0));
}

BENCHMARK(in_lanes<false>)->Name("sweep/q2d/lanes");
BENCHMARK(in_lanes<true>)->Name("sweep/q2d/lanes_with_friction");
BENCHMARK(alone<false>)->Name("sweep/q2d/one_by_one");
BENCHMARK(alone<true>)->Name("sweep/q2d/one_by_one_with_friction");
BENCHMARK(loaded<false>)->Name("sweep/q2d/loaded_at_run_time");
BENCHMARK(loaded<true>)->Name("sweep/q2d/loaded_at_run_time_with_friction");

}  // namespace
