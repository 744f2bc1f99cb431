// SPDX-License-Identifier: Apache-2.0
// The equations of motion of the Q2D, function by function.
#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/q2d.hpp>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace {

using namespace articula;

struct Sample {
  JointVector<2> q, v, a;
};

std::array<Sample, 256> make_samples() {
  std::array<Sample, 256> samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double phase = static_cast<double>(i);
    samples[i] = {{std::sin(phase), std::cos(1.7 * phase)},
                  {std::cos(2.3 * phase), std::sin(0.9 * phase)},
                  {std::sin(3.1 * phase), std::cos(0.3 * phase)}};
  }
  return samples;
}

template <class Function>
void run(benchmark::State& bench, Function function) {
  const auto samples = make_samples();
  std::size_t i = 0;
  for (auto _ : bench) {
    auto result = function(samples[i++ % samples.size()]);
    benchmark::DoNotOptimize(result);
  }
}

void empty_body(benchmark::State& bench) {
  run(bench, [](const Sample& s) { return s.q; });
}
void inverse_dynamics_q2d(benchmark::State& bench) {
  run(bench, [](const Sample& s) { return inverse_dynamics(Q2d{}, s.q, s.v, s.a); });
}
void gravity_q2d(benchmark::State& bench) {
  run(bench, [](const Sample& s) { return gravity(Q2d{}, s.q); });
}
void nonlinear_effects_q2d(benchmark::State& bench) {
  run(bench, [](const Sample& s) { return nonlinear_effects(Q2d{}, s.q, s.v); });
}
void mass_matrix_q2d(benchmark::State& bench) {
  run(bench, [](const Sample& s) { return mass_matrix(Q2d{}, s.q); });
}
void forward_dynamics_q2d(benchmark::State& bench) {
  run(bench, [](const Sample& s) { return forward_dynamics(Q2d{}, s.q, s.v, s.a); });
}
void forward_kinematics_q2d(benchmark::State& bench) {
  constexpr LinkIndex tool = link_index(Q2d{}, "tool_link");
  run(bench, [&](const Sample& s) { return forward_kinematics(Q2d{}, s.q, tool); });
}

BENCHMARK(empty_body);
BENCHMARK(inverse_dynamics_q2d);
BENCHMARK(gravity_q2d);
BENCHMARK(nonlinear_effects_q2d);
BENCHMARK(mass_matrix_q2d);
BENCHMARK(forward_dynamics_q2d);
BENCHMARK(forward_kinematics_q2d);

}  // namespace
