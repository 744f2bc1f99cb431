// SPDX-License-Identifier: Apache-2.0
// Runs of a sweep in one thread: under one controller for all lanes, under one for each run, and
// one by one. /threads is a sweep of more runs in one thread and in two. Each run is a second at 1
// kHz of another robot under PID plus gravity: other masses, damping, start and gains.
// `cycles_per_second` counts the cycles of all runs, set-up and metrics included.
#include <articula/articula.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>
#include <articula/sweep/closed_loop_experiment.hpp>
#include <articula/sweep/sweep.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

namespace {

using namespace articula;

/// The middle of each joint's range.
template <class R>
JointVector<joint_count<R>> middle() {
  return joint_values(R(), [](const JointProperties& joint) {
    return joint.limits.lower + 0.5 * (joint.limits.upper - joint.limits.lower);
  });
}

/// Gains of 10 rad/s for the inertia at the start.
template <class R>
JointPidGains<joint_count<R>> gains() {
  JointPidGains<joint_count<R>> all{};
  const auto inertia = mass_matrix(R(), middle<R>());
  for (int j = 0; j < joint_count<R>; ++j) {
    PidGains& g = all[static_cast<std::size_t>(j)];
    g.proportional = 100 * inertia(j, j);
    g.derivative = 20 * inertia(j, j);
    g.integral = 100 * inertia(j, j);
    g.integral_clamp_max = 0.2 * effort_limits(R())[j];
    g.integral_clamp_min = -g.integral_clamp_max;
  }
  return all;
}

template <class R>
constexpr auto one_for_all_lanes =
    []<class S>(const JointPidGains<joint_count<R>, S>& own) { return PidPlusGravity<R, S>(own); };
template <class R>
constexpr auto one_for_each_run =
    [](const JointPidGains<joint_count<R>>& own) { return PidPlusGravity<R>(own); };

/// The sum of all joints' viscous damping. The UR10 is described without.
template <class R>
double sum_of_damping() {
  return joint_values(R(), [](const JointProperties& joint) { return joint.damping; }).sum();
}

template <class R>
auto experiment_of(const auto& robot, const auto& make, double friction) {
  constexpr int n = joint_count<R>;
  ClosedLoopOptions<n> options;
  options.simulation.initial_position = middle<R>();
  options.target = middle<R>() + JointVector<n>::Constant(0.3);
  options.vary = {{VariedQuantity::mass, {}, 0.8, 1.2},
                  {VariedQuantity::initial_position, {}, -0.1, 0.1},
                  {VariedQuantity::proportional, {}, 0.8, 1.2}};
  if (sum_of_damping<R>() > 0) options.vary.push_back({VariedQuantity::damping, {}, 0.8, 1.2});
  if (friction > 0) {
    options.vary.push_back({VariedQuantity::added_friction, {}, 0, friction});
  }
  return ClosedLoopExperiment(robot, gains<R>(), make, options);
}

constexpr std::uint64_t runs = 64;

void count_runs(benchmark::State& bench) {
  const double count = static_cast<double>(bench.iterations()) * runs;
  bench.counters["runs_per_second"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
  bench.counters["cycles_per_second"] =
      benchmark::Counter(1000 * count, benchmark::Counter::kIsRate);
}

/// As `sweep` runs them in each thread.
void sweep_chunks(benchmark::State& bench, const auto& experiment) {
  const Samples samples(experiment.parameters(), {.runs = runs});
  for (auto _ : bench) {
    benchmark::DoNotOptimize(run_chunk(experiment, samples, {0, runs}));
  }
  count_runs(bench);
}

template <class R, bool Friction>
void in_lanes(benchmark::State& bench) {
  sweep_chunks(bench, experiment_of<R>(R(), one_for_all_lanes<R>, Friction ? 0.5 : 0));
  bench.counters["lanes"] = lanes<LanePack<R>>;
}
template <class R>
void own_controllers(benchmark::State& bench) {
  sweep_chunks(bench, experiment_of<R>(R(), one_for_each_run<R>, 0));
  bench.counters["lanes"] = lanes<LanePack<R>>;
}
template <class R, bool Friction>
void alone(benchmark::State& bench) {
  const auto experiment = experiment_of<R>(R(), one_for_each_run<R>, Friction ? 0.5 : 0);
  const Samples samples(experiment.parameters(), {.runs = runs});
  std::vector<double> metrics(experiment.metrics().size()), values(samples.parameters().size());
  for (auto _ : bench) {
    for (std::uint64_t k = 0; k < runs; ++k) {
      samples.values(k, values);
      const auto loop = experiment.loop({k, samples.seed(k), values});
      benchmark::DoNotOptimize(experiment.run_alone(loop, metrics));
    }
  }
  count_runs(bench);
}
/// A sweep in a number of threads, in lanes.
template <class R>
void in_threads(benchmark::State& bench) {
  const auto experiment = experiment_of<R>(R(), one_for_all_lanes<R>, 0);
  constexpr std::uint64_t count = 100 * runs;
  const SweepOptions options{.sampling = {.runs = count},
                             .threads = static_cast<int>(bench.range(0))};
  for (auto _ : bench) benchmark::DoNotOptimize(sweep(experiment, options));
  bench.counters["cycles_per_second"] = benchmark::Counter(
      1000.0 * count * static_cast<double>(bench.iterations()), benchmark::Counter::kIsRate);
}
/// What each run costs before its first cycle: robot, gains and options.
template <class R>
void set_up(benchmark::State& bench) {
  const auto experiment = experiment_of<R>(R(), one_for_each_run<R>, 0);
  const Samples samples(experiment.parameters(), {.runs = runs});
  std::vector<double> values(samples.parameters().size());
  std::uint64_t k = 0;
  for (auto _ : bench) {
    samples.values(k++ % runs, values);
    benchmark::DoNotOptimize(experiment.loop({k, samples.seed(k), values}));
  }
}
void loaded(benchmark::State& bench) {
  sweep_chunks(bench,
               experiment_of<Q2d>(detail::ModelOf<Q2d>(model_of(Q2d())), one_for_each_run<Q2d>, 0));
}

#define ARTICULA_SWEEP(robot, Robot)                                                             \
  BENCHMARK(in_lanes<Robot, false>)->Name("sweep/" #robot "/lanes");                             \
  BENCHMARK(in_lanes<Robot, true>)->Name("sweep/" #robot "/lanes_with_friction");                \
  BENCHMARK(own_controllers<Robot>)->Name("sweep/" #robot "/lanes_with_own_controllers");        \
  BENCHMARK(alone<Robot, false>)->Name("sweep/" #robot "/one_by_one");                           \
  BENCHMARK(alone<Robot, true>)->Name("sweep/" #robot "/one_by_one_with_friction");              \
  BENCHMARK(in_threads<Robot>)->Name("sweep/" #robot "/threads")->Arg(1)->Arg(2)->UseRealTime(); \
  BENCHMARK(set_up<Robot>)->Name("sweep/" #robot "/set_up")

ARTICULA_SWEEP(q2d, Q2d);
ARTICULA_SWEEP(ur10, Ur10);
ARTICULA_SWEEP(panda, Panda);
BENCHMARK(loaded)->Name("sweep/q2d/loaded_at_run_time");

}  // namespace
