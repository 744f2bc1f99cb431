// SPDX-License-Identifier: Apache-2.0
// Closed loops at 1 kHz of robots that all differ in mass, friction and inertia, PID plus gravity,
// Runge-Kutta: in the lanes of LanePack, and one after the other. `cycles_per_second` counts the
// cycles of all robots. /varied is a type whose numbers are inputs, /described the robot itself,
// the same in all lanes.
#include <articula/articula.hpp>
#include <articula/lanes/lane_loop.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace {

using namespace articula;

template <class R>
std::vector<LaneSetup<R>> setups(double friction) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> factor(0.8, 1.2);
  std::vector<LaneSetup<R>> all(lanes<LanePack<R>>);
  for (LaneSetup<R>& setup : all) {
    auto model = model_of(R{});
    for (Body& body : model.mechanism.bodies) {
      const double scale = factor(engine);
      body.inertia.mass *= scale;
      body.inertia.first_moment = scale * body.inertia.first_moment;
      Symmetric3<double>& m = body.inertia.moment;
      for (double* x : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) *x *= scale;
    }
    for (JointProperties& joint : model.joints) {
      joint.damping *= factor(engine);
      joint.friction = friction * joint.limits.effort * factor(engine);
    }
    setup.robot = VariedRobot<R>(model);
    JointVector<joint_count<R>> start;
    for (int j = 0; j < joint_count<R>; ++j) {
      const JointLimits& limits = model.joints[j].limits;
      start[j] = limits.lower + 0.5 * (limits.upper - limits.lower);
    }
    setup.simulation.initial_position = start;
  }
  return all;
}

/// Gains of 10 rad/s for the inertia at the start.
template <class R>
JointPidGains<joint_count<R>> gains() {
  JointPidGains<joint_count<R>> all{};
  const auto inertia = mass_matrix(R(), *setups<R>(0)[0].simulation.initial_position);
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

/// The reference goes to and fro, so that the arms are always on their way.
template <int N>
JointVector<N> wanted(const JointVector<N>& start, std::size_t cycle) {
  return start + JointVector<N>::Constant((cycle / 500) % 2 == 0 ? 0.3 : -0.3);
}

template <class R, bool Friction>
void in_lanes(benchmark::State& bench) {
  const auto all = setups<R>(Friction ? 0.02 : 0);
  LaneLoop<R, PidPlusGravity> loop(all, PidPlusGravity<R, LanePack<R>>(gains<R>()));
  const auto start = *all[0].simulation.initial_position;
  std::size_t cycle = 0;
  for (auto _ : bench) {
    if (cycle % 500 == 0) {
      for (int k = 0; k < loop.lane_count; ++k) {
        loop.set_reference(k, {.position = wanted<joint_count<R>>(start, cycle)});
      }
    }
    ++cycle;
    loop.update();
    benchmark::ClobberMemory();
  }
  if (!all_of(loop.running())) bench.SkipWithError("a lane has ended");
  bench.counters["lanes"] = loop.lane_count;
  bench.counters["cycles_per_second"] =
      benchmark::Counter(static_cast<double>(cycle) * loop.lane_count, benchmark::Counter::kIsRate);
}

template <class Loop, class Start>
void cycles_of(benchmark::State& bench, Loop& loop, const Start& start, int robots) {
  std::size_t cycle = 0;
  for (auto _ : bench) {
    const auto q = wanted(start, cycle++);
    if (cycle % 500 == 1) {
      for (int j = 0; j < Loop::joint_count; ++j) loop.reference().position[j] = q[j];
    }
    Status status = loop.update();
    benchmark::DoNotOptimize(status);
    if (status != Status::ok) bench.SkipWithError("the loop has failed");
  }
  bench.counters["cycles_per_second"] =
      benchmark::Counter(static_cast<double>(cycle) * robots, benchmark::Counter::kIsRate);
}

/// One robot with numbers of its own.
template <class R, bool Friction>
void varied(benchmark::State& bench) {
  const auto setup = setups<R>(Friction ? 0.02 : 0)[1];
  using Varied = VariedRobot<R>;
  ControlLoop<Simulator<Varied>, PidPlusGravity<R>> loop(
      Simulator<Varied>(setup.robot, setup.simulation), PidPlusGravity<R>(gains<R>()));
  cycles_of(bench, loop, *setup.simulation.initial_position, 1);
}
/// The described robot, without friction.
template <class R, class S>
void described(benchmark::State& bench) {
  const auto simulation = setups<R>(0)[0].simulation;
  ControlLoop<Simulator<R, S>, PidPlusGravity<R, S>> loop(Simulator<R, S>(R(), simulation),
                                                          PidPlusGravity<R, S>(gains<R>()));
  cycles_of(bench, loop, *simulation.initial_position, lanes<S>);
}

#define ARTICULA_LANES(robot, Robot)                                                               \
  BENCHMARK(in_lanes<Robot, false>)->Name("closed_loop/" #robot "/lanes");                         \
  BENCHMARK(in_lanes<Robot, true>)->Name("closed_loop/" #robot "/lanes_with_friction");            \
  BENCHMARK(described<Robot, LanePack<Robot>>)->Name("closed_loop/" #robot "/described_in_lanes"); \
  BENCHMARK(varied<Robot, false>)->Name("closed_loop/" #robot "/varied_one_by_one");               \
  BENCHMARK(varied<Robot, true>)->Name("closed_loop/" #robot "/varied_one_by_one_with_friction");  \
  BENCHMARK(described<Robot, double>)->Name("closed_loop/" #robot "/described_one_by_one")

ARTICULA_LANES(q2d, Q2d);
ARTICULA_LANES(ur10, Ur10);
ARTICULA_LANES(panda, Panda);

}  // namespace
