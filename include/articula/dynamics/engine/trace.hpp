// SPDX-License-Identifier: Apache-2.0
/// @file Tracing an algorithm over symbols, which gives a straight-line program.
#pragma once

#include "articula/dynamics/engine/algorithm_traits.hpp"
#include "articula/dynamics/engine/configuration.hpp"
#include "articula/dynamics/engine/input_numbers.hpp"
#include "articula/model/robot.hpp"
#include "articula/symbolic/assembler.hpp"
#include "articula/symbolic/scalars.hpp"
#include "articula/symbolic/symbol.hpp"

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace articula::compiled::detail {

template <DescribedRobot R>
using ModelOf = std::remove_cvref_t<decltype(model_of(R{}))>;

/// The number of an algorithm's inputs after the configuration, arrays of N numbers.
template <class Algorithm, class S, int N, int B, std::size_t Arrays = 0>
consteval std::size_t input_arrays() {
  constexpr bool fits = []<std::size_t... I>(std::index_sequence<I...>) {
    return requires(const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration,
                    const std::array<JointArray<S, N>, Arrays>& inputs) {
      Algorithm::template evaluate<S, N, B>(mechanism, configuration, inputs[I]...);
    };
  }(std::make_index_sequence<Arrays>{});
  if constexpr (fits || LinkAlgorithm<Algorithm>) {
    return Arrays;
  } else {
    static_assert(Arrays < 8, "articula: this is not an algorithm of a configuration and arrays");
    return input_arrays<Algorithm, S, N, B, Arrays + 1>();
  }
}

/// The numbers of a robot's bodies as symbols: constants, or inputs where they are inputs.
/// @param next  the number of the next input
template <DescribedRobot R>
[[nodiscard]] constexpr auto symbolic_numbers(symbolic::Graph& graph, int next) {
  using symbolic::Symbol;
  JointArray<BodyNumbers<Symbol>, ModelOf<R>::body_count> numbers;
  std::size_t place = 0;
  for (int i = 0; i < ModelOf<R>::body_count; ++i) {
    numbers[i] = numbers_of<Symbol>(model_of(R{}).canonical.bodies[i]);
    if constexpr (articula::detail::has_input_numbers<R>) {
      constexpr auto is_input = articula::detail::input_mask<R>();
      for_each_number(numbers[i], [&](Symbol& number) {
        if (is_input[place++]) number = Symbol(graph, graph.input(next++));
      });
    }
  }
  return numbers;
}

/// Runs an algorithm on symbols and assembles a program from the resulting graph. Inputs are
/// numbered through the positions, then through the algorithm's other arrays, see Concatenated,
/// then through the numbers of the bodies that are inputs.
/// @tparam Capacity  the largest program
template <class Algorithm, DescribedRobot R, Frames frames, symbolic::ProgramSize Capacity>
[[nodiscard]] constexpr symbolic::Program<Capacity> trace() {
  using symbolic::Symbol;
  constexpr int n = ModelOf<R>::joint_count, b = ModelOf<R>::body_count;
  constexpr std::size_t arrays = input_arrays<Algorithm, Symbol, n, b>();

  symbolic::Graph graph;
  std::array<JointArray<Symbol, n>, 1 + arrays> inputs;
  int next = 0;
  symbolic::for_each_scalar<Symbol>(
      inputs, [&](Symbol& symbol) { symbol = Symbol(graph, graph.input(next++)); });
  auto result = [&]<std::size_t... I>(std::index_sequence<I...>) {
    if constexpr (LinkAlgorithm<Algorithm>) {
      return Algorithm::template evaluate<frames, Symbol>(model_of(R{}), inputs[0]);
    } else {
      const auto& mechanism = mechanism_for<Algorithm>(R{});
      const auto configuration = [&] {
        if constexpr (articula::detail::has_input_numbers<R>) {
          static_assert(!needs_own_frames<Algorithm>);
          const auto numbers = symbolic_numbers<R>(graph, next);
          return configuration_of<Symbol, n, b, frames>(mechanism, inputs[0],
                                                        [&](int i) { return numbers[i]; });
        } else {
          return configuration_of<Symbol, n, b, frames>(mechanism, inputs[0]);
        }
      }();
      return Algorithm::template evaluate<Symbol, n, b>(mechanism, configuration, inputs[1 + I]...);
    }
  }(std::make_index_sequence<arrays>{});

  symbolic::GrowingArray<symbolic::Term> outputs(128);
  symbolic::for_each_scalar<Symbol>(result, [&](Symbol& symbol) { outputs.append(symbol.term()); });
  return symbolic::Assembler<Capacity>::assemble(graph, outputs);
}

/// A capacity that is at least twice the size of the programs of this library.
template <DescribedRobot R>
[[nodiscard]] consteval symbolic::ProgramSize usual_capacity() {
  constexpr auto bodies = static_cast<std::size_t>(ModelOf<R>::body_count);
  return {
      .instructions = 384 * bodies, .constants = 32 * bodies, .outputs = (12 + bodies) * bodies};
}

/// The program of an algorithm. It runs a second time only if the capacity was too small.
template <class Algorithm, DescribedRobot R, Frames frames>
[[nodiscard]] consteval auto compile() {
  constexpr auto program = trace<Algorithm, R, frames, usual_capacity<R>()>();
  if constexpr (program.is_complete()) {
    return program;
  } else {
    return trace<Algorithm, R, frames, program.size>();
  }
}

}  // namespace articula::compiled::detail
