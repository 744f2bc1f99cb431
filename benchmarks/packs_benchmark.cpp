// SPDX-License-Identifier: Apache-2.0
// Sixteen robots side by side, <operation>/<robot>/together, and one after the other, /one_by_one:
// the ratio of the two is what packs gain per robot. `lanes` is how many doubles fit into a
// register. A single robot's sines already are taken in its lanes; /plain is one by one with those
// of <cmath>. /model_... are the same of a robot that is loaded at run time.
#include <articula/dynamics/forward_dynamics.hpp>
#include <articula/dynamics/inverse_dynamics.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/robots/ur10.hpp>

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

namespace {

using namespace articula;

constexpr int robots = 16;
constexpr std::size_t sets = 4;  // of sixteen robots; more would not stay in the first cache

struct Inverse {
  using Algorithm = InverseDynamics;
  template <class R, class... Arrays>
  static auto run(const R& robot, const Arrays&... arrays) {
    return inverse_dynamics(robot, arrays...);
  }
};
struct Forward {
  using Algorithm = ForwardDynamics;
  template <class R, class... Arrays>
  static auto run(const R& robot, const Arrays&... arrays) {
    return forward_dynamics(robot, arrays...);
  }
};

/// A robot as the compiler knows it.
template <class R>
struct Described {
  static constexpr R robot{};
};
/// The same robot as if it had been loaded: not constant, so that nothing of it is known.
template <class R>
struct Loaded {
  static inline auto robot = model_of(R{});
};

template <class From>
constexpr int joints_of = joint_count<std::remove_cvref_t<decltype(From::robot)>>;

/// A double that the library does not know as one.
struct Plain {
  double x;
  Plain() = default;
  explicit Plain(double number) : x(number) {}
  friend Plain operator+(Plain a, Plain b) { return Plain(a.x + b.x); }
  friend Plain operator-(Plain a, Plain b) { return Plain(a.x - b.x); }
  friend Plain operator*(Plain a, Plain b) { return Plain(a.x * b.x); }
  friend Plain operator/(Plain a, Plain b) { return Plain(a.x / b.x); }
  friend Plain operator-(Plain a) { return Plain(-a.x); }
  friend Plain sin(Plain a) { return Plain(std::sin(a.x)); }
  friend Plain cos(Plain a) { return Plain(std::cos(a.x)); }
};

/// Random states: positions, velocities and efforts or accelerations.
template <class Vectors>
std::vector<std::array<Vectors, 3>> random_states(std::size_t count) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> number(-3, 3);
  std::vector<std::array<Vectors, 3>> states(count);
  for (auto& state : states) {
    for (Vectors& values : state) values = values.unaryExpr([&](double) { return number(engine); });
  }
  return states;
}

template <class Operation, class From>
void together(benchmark::State& bench) {
  const auto states = random_states<JointVectors<joints_of<From>, robots>>(sets);
  std::size_t i = 0;
  for (auto _ : bench) {
    const auto& [q, v, x] = states[i++ % states.size()];
    auto result = Operation::run(From::robot, q, v, x);
    benchmark::DoNotOptimize(result);
  }
  bench.counters["lanes"] = symbolic::lanes_of_a_register;
}

template <class Operation, class From>
void one_by_one(benchmark::State& bench) {
  const auto states = random_states<JointVector<joints_of<From>>>(sets * robots);
  std::size_t i = 0;
  for (auto _ : bench) {
    for (int k = 0; k < robots; ++k) {
      const auto& [q, v, x] = states[i++ % states.size()];
      auto result = Operation::run(From::robot, q, v, x);
      benchmark::DoNotOptimize(result);
    }
  }
  bench.counters["lanes"] = symbolic::lanes_of_a_register;
}

template <class Operation, class R>
void plain(benchmark::State& bench) {
  constexpr auto n = std::size_t{joint_count<R>};
  const auto states = random_states<JointVector<joint_count<R>>>(sets * robots);
  std::size_t i = 0;
  for (auto _ : bench) {
    for (int k = 0; k < robots; ++k) {
      std::array<std::array<Plain, n>, 3> inputs;
      for (std::size_t j = 0; j < 3; ++j) {
        const auto& vector = states[i % states.size()][j];
        for (std::size_t l = 0; l < n; ++l) {
          inputs[j][l] = Plain(vector[static_cast<Eigen::Index>(l)]);
        }
      }
      ++i;
      const auto& [q, v, x] = inputs;
      auto result = compiled::run<typename Operation::Algorithm, R>(q, v, x);
      benchmark::DoNotOptimize(result);
    }
  }
}

#define ARTICULA_PACKS(operation, Operation, robot, Robot)                           \
  BENCHMARK(together<Operation, Described<Robot>>)                                   \
      ->Name(#operation "_dynamics/" #robot "/together");                            \
  BENCHMARK(one_by_one<Operation, Described<Robot>>)                                 \
      ->Name(#operation "_dynamics/" #robot "/one_by_one");                          \
  BENCHMARK(plain<Operation, Robot>)->Name(#operation "_dynamics/" #robot "/plain"); \
  BENCHMARK(together<Operation, Loaded<Robot>>)                                      \
      ->Name(#operation "_dynamics/" #robot "/model_together");                      \
  BENCHMARK(one_by_one<Operation, Loaded<Robot>>)                                    \
      ->Name(#operation "_dynamics/" #robot "/model_one_by_one")

ARTICULA_PACKS(inverse, Inverse, q2d, Q2d);
ARTICULA_PACKS(inverse, Inverse, ur10, Ur10);
ARTICULA_PACKS(inverse, Inverse, panda, Panda);
ARTICULA_PACKS(forward, Forward, q2d, Q2d);
ARTICULA_PACKS(forward, Forward, ur10, Ur10);
ARTICULA_PACKS(forward, Forward, panda, Panda);

}  // namespace
