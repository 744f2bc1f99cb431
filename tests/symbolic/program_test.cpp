// SPDX-License-Identifier: Apache-2.0
#include "articula/symbolic/assembler.hpp"
#include "articula/symbolic/run_program.hpp"
#include "articula/symbolic/symbol.hpp"

#include "catch.hpp"

#include <cmath>
#include <numbers>

#if __has_include(<xsimd/xsimd.hpp>)
#include <xsimd/xsimd.hpp>
#endif

using namespace articula::symbolic;  // NOLINT

namespace {

constexpr ProgramSize room{.instructions = 2000, .constants = 500, .outputs = 8};

template <ProgramSize Room, std::size_t Inputs, class Function>
constexpr Program<Room> record(const Function& function) {
  Graph graph;
  std::array<Symbol, Inputs> inputs;
  for (int i = 0; Symbol & input : inputs) input = Symbol(graph, graph.input(i++));
  GrowingArray<Term> outputs(1);
  for (const Symbol& output : function(inputs)) outputs.append(output.term());
  return Assembler<Room>::assemble(graph, outputs);
}

template <class Function, std::size_t Inputs>
constexpr auto program = record<room, Inputs>(Function{});

/// All operations, angles that depend on sums and on other sines, and results that are constant, an
/// input, negative or the same as another.
struct Everything {
  template <class S>
  constexpr std::array<S, 8> operator()(const std::array<S, 3>& in) const {
    using std::cos, std::sin, std::sqrt;
    const auto [x, y, z] = in;
    const S s = sin(x + y), c = cos(x + y), nested = sin(c + z);
    return {s * x - c * y,
            -(x * y),
            sqrt(x * x + S(2.0)) / (y * y + S(1.0)),
            nested * cos(z),
            S(0.25),
            z,
            -s,
            s * x - c * y};
  }
};

/// More steps than a compiler folds at once.
struct LongSum {
  template <class S>
  constexpr std::array<S, 2> operator()(const std::array<S, 2>& in) const {
    S power = in[0], sum = S(1.0);
    for (int k = 1; k <= 400; ++k) {
      sum = sum + power;
      power = power * in[0] * S(1.0 / k);
    }
    return {sum, power * in[1]};
  }
};

}  // namespace

TEST_CASE("A program computes what its function computes") {
  static constexpr const auto& compiled = program<Everything, 3>;
  for (double t = -3; t < 3; t += 0.1) {
    const std::array<double, 3> in{t, 0.3 - t, 0.7 * t};
    const auto expected = Everything{}(in);
    const auto result = run_program<compiled>(in);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      CAPTURE(t, i);
      CHECK(result[i] == Approx(expected[i]).epsilon(1e-14).margin(1e-15));
    }
  }
}

TEST_CASE("A program runs for floats") {
  static constexpr const auto& compiled = program<Everything, 3>;
  const std::array<float, 3> in{0.5F, -1.25F, 0.75F};
  const auto expected = Everything{}(in);
  const auto result = run_program<compiled>(in);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(static_cast<double>(result[i]) ==
          Approx(static_cast<double>(expected[i])).epsilon(1e-6).margin(1e-7));
  }
}

#if __has_include(<xsimd/xsimd.hpp>)
TEST_CASE("A program runs for packs of numbers") {
  static constexpr const auto& compiled = program<Everything, 3>;
  using Pack = xsimd::batch<double>;
  std::array<double, Pack::size> x{};
  for (std::size_t lane = 0; lane < x.size(); ++lane) x[lane] = 0.3 * static_cast<double>(lane) - 1;
  const auto result = run_program<compiled>(
      std::array<Pack, 3>{Pack::load_unaligned(x.data()), Pack(0.5), Pack(-0.25)});
  for (std::size_t lane = 0; lane < x.size(); ++lane) {
    const auto expected = Everything{}(std::array<double, 3>{x[lane], 0.5, -0.25});
    for (std::size_t i = 0; i < expected.size(); ++i) {
      CAPTURE(lane, i);
      CHECK(result[i].get(lane) == Approx(expected[i]).epsilon(1e-13).margin(1e-14));
    }
  }
}
#endif

TEST_CASE("A program may be long") {
  static constexpr const auto& compiled = program<LongSum, 2>;
  STATIC_REQUIRE(compiled.size.instructions > 1000);
  const auto result = run_program<compiled>(std::array<double, 2>{1.5, 2.0});
  CHECK(result[0] == Approx(1 + 1.5 * std::exp(1.5)).epsilon(1e-14));
}

TEST_CASE("Operations are counted, and what nobody needs is not computed") {
  constexpr OperationCounts counts = program<Everything, 3>.operations();
  STATIC_REQUIRE(counts.multiplications == 6);
  STATIC_REQUIRE(counts.additions == 5);
  STATIC_REQUIRE(counts.divisions == 1);
  STATIC_REQUIRE(counts.square_roots == 1);
  STATIC_REQUIRE(counts.sines == 3);

  constexpr auto wasteful = [](const auto& in) {
    const auto unused = sin(in[1]) * in[0];
    static_cast<void>(unused);
    return std::array{in[0] * in[1]};
  };
  STATIC_REQUIRE(record<room, 2>(wasteful).size.instructions == 3);
}

TEST_CASE("A program that finds no room says how much it takes") {
  constexpr ProgramSize size = program<Everything, 3>.size;
  STATIC_REQUIRE(record<size, 3>(Everything{}).is_complete());
  constexpr auto partial = record<ProgramSize{10, 1, 5}, 3>(Everything{});
  STATIC_REQUIRE_FALSE(partial.is_complete());
  STATIC_REQUIRE(partial.size.instructions == size.instructions);
  STATIC_REQUIRE(partial.size.constants == size.constants);
  STATIC_REQUIRE(partial.size.outputs == size.outputs);
}

TEST_CASE("Sines and cosines that can be taken together stand together, in pairs") {
  constexpr const auto& compiled = program<Everything, 3>;
  STATIC_REQUIRE(compiled.angles_end - compiled.angles_begin == 4);  // of x + y and of z
  for (std::size_t i = compiled.angles_begin; i < compiled.angles_end; i += 2) {
    CHECK(compiled.instructions[i].operation == Operation::sine);
    CHECK(compiled.instructions[i + 1].operation == Operation::cosine);
    CHECK(compiled.instructions[i].left == compiled.instructions[i + 1].left);
  }
}

/// An angle, its sine, a product that the angle does not need, and the sine of a sine.
struct Late {
  template <class S>
  constexpr std::array<S, 4> operator()(const std::array<S, 3>& in) const {
    using std::sin;
    const S angle = in[0] + in[1], product = in[1] * in[2], sine = sin(angle);
    return {angle, sine, sine * product, sin(sine + product)};
  }
};

TEST_CASE("Before the angles there is what they need, and nothing else") {
  constexpr const auto& compiled = program<Late, 3>;
  STATIC_REQUIRE(compiled.angles_begin == 3);  // two inputs and their sum
  STATIC_REQUIRE(compiled.angles_end == 5);
  const std::array<double, 3> in{0.5, -1.25, 0.75};
  const auto result = run_program<compiled>(in), expected = Late{}(in);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(result[i] == Approx(expected[i]).epsilon(1e-15));
  }
}
