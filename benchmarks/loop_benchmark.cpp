// SPDX-License-Identifier: Apache-2.0
// The Q2D: update() of each controller alone, a step of the simulator, and the whole control cycle.
#include <articula/articula.hpp>
#include <articula/robots/q2d.hpp>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace {

using namespace articula;

/// Inputs that change from call to call, so that nothing can be computed in advance.
std::array<JointState<2>, 256> make_states() {
  std::array<JointState<2>, 256> states;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double phase = static_cast<double>(i);
    states[i].position = {std::sin(phase), std::cos(1.7 * phase)};
    states[i].velocity = {std::cos(2.3 * phase), std::sin(0.9 * phase)};
  }
  return states;
}

void empty_body(benchmark::State& bench) {
  const auto states = make_states();
  std::size_t i = 0;
  for (auto _ : bench) {
    JointState<2> state = states[i++ % states.size()];
    benchmark::DoNotOptimize(state);
  }
}

template <template <class> class ControllerTemplate>
void controller_update(benchmark::State& bench) {
  const auto states = make_states();
  ControllerTemplate<Q2d> controller;
  controller.start({states[0], {}, 1e-3});
  JointReference<2> reference;
  reference.effort = {1, 1};
  std::size_t i = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(reference);
    EffortCommand<2> command = controller.update({states[i++ % states.size()], reference, 1e-3});
    benchmark::DoNotOptimize(command);
  }
}

/// The reference goes to and fro, so that the arm is always on its way.
template <class AnyLoop>
void swing(AnyLoop& loop, std::size_t cycle) {
  const double side = (cycle / 500) % 2 == 0 ? 1 : -1;
  loop.reference().position = {-side, side};
  loop.reference().effort = {side, side};
}

template <template <class> class ControllerTemplate>
void loop_cycle(benchmark::State& bench) {
  Loop<Q2dSim, ControllerTemplate> loop;
  std::size_t cycle = 0;
  for (auto _ : bench) {
    swing(loop, cycle++);
    Status status = loop.update();
    benchmark::DoNotOptimize(status);
  }
  bench.counters["simulated_seconds_per_second"] =
      benchmark::Counter(static_cast<double>(cycle) * loop.period(), benchmark::Counter::kIsRate);
}

/// One period of the simulated arm under an effort that keeps it moving between its stops.
void simulator_step(benchmark::State& bench) {
  Q2dSim simulator;
  EffortCommand<2> command;
  std::size_t step = 0;
  for (auto _ : bench) {
    const double side = (step++ / 500) % 2 == 0 ? 1 : -1;
    command.effort = {3 * side, -side};
    Status status = simulator.write(command);
    benchmark::DoNotOptimize(status);
  }
  bench.counters["simulated_seconds_per_second"] =
      benchmark::Counter(simulator.time(), benchmark::Counter::kIsRate);
}

BENCHMARK(empty_body);
BENCHMARK(controller_update<Bypass>)->Name("controller_update/Bypass");
BENCHMARK(controller_update<Pid>)->Name("controller_update/Pid");
BENCHMARK(controller_update<PidPlusGravity>)->Name("controller_update/PidPlusGravity");
BENCHMARK(controller_update<ComputedTorque>)->Name("controller_update/ComputedTorque");
BENCHMARK(simulator_step);
BENCHMARK(loop_cycle<Bypass>)->Name("loop_cycle/Bypass");
BENCHMARK(loop_cycle<Pid>)->Name("loop_cycle/Pid");
BENCHMARK(loop_cycle<PidPlusGravity>)->Name("loop_cycle/PidPlusGravity");
BENCHMARK(loop_cycle<ComputedTorque>)->Name("loop_cycle/ComputedTorque");

}  // namespace
