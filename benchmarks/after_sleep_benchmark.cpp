// SPDX-License-Identifier: Apache-2.0
// The Panda's dynamics in a tight loop, <operation>/<robot>/hot, and in a loop that sleeps a
// millisecond between calls, /after_sleep. A control loop sees the latter.
#include "after_sleep.hpp"

#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/panda.hpp>

#include <array>
#include <cmath>
#include <string>

namespace {

using namespace articula;

constexpr int n = joint_count<Panda>;

struct Sample {
  JointVector<n> q, v, x;
};

std::array<Sample, 256> make_samples() {
  std::array<Sample, 256> samples;
  double phase = 0;
  for (Sample& sample : samples) {
    for (int i = 0; i < n; ++i) {
      phase += 0.7;
      sample.q[i] = 3 * std::sin(phase);
      sample.v[i] = 2 * std::cos(1.3 * phase);
      sample.x[i] = 5 * std::sin(2.1 * phase);
    }
  }
  return samples;
}

const std::array<Sample, 256> samples = make_samples();
auto loaded = model_of(Panda{});  // not constant: nothing of it is known

template <class Function>
void add(const std::string& name, const Function& function) {
  const auto call = [function](std::size_t i) {
    const Sample& s = samples[i % samples.size()];
    auto result = function(s);
    benchmark::DoNotOptimize(result);
  };
  benchmark::RegisterBenchmark((name + "/hot").c_str(), [call](benchmark::State& bench) {
    std::size_t i = 0;
    for (auto _ : bench) call(i++);
  });
  register_after_sleep(name, call);
}

const bool added = [] {
  register_after_sleep("clock", [](std::size_t) {});
  add("inverse_dynamics/panda",
      [](const Sample& s) { return inverse_dynamics(Panda{}, s.q, s.v, s.x); });
  add("inverse_dynamics/panda_model",
      [](const Sample& s) { return inverse_dynamics(loaded, s.q, s.v, s.x); });
  add("forward_dynamics/panda",
      [](const Sample& s) { return forward_dynamics(Panda{}, s.q, s.v, s.x); });
  add("forward_dynamics/panda_model",
      [](const Sample& s) { return forward_dynamics(loaded, s.q, s.v, s.x); });
  return true;
}();

}  // namespace
