// SPDX-License-Identifier: Apache-2.0
/// @file Execution of straight-line programs for any scalar.
#pragma once

#include "articula/symbolic/program.hpp"
#include "articula/symbolic/sine_cosine.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace articula::symbolic {

namespace detail {

/// Computes what one step of a program says. The numbers of the operands are constants to the
/// optimiser, which keeps the values in registers.
template <Operation operation, class S>
[[gnu::always_inline]] inline S execute(const S* value, const S* input, const double* constant,
                                        std::size_t left, std::size_t right) noexcept {
  using std::cos, std::sin, std::sqrt;
  if constexpr (operation == Operation::input) return input[left];
  if constexpr (operation == Operation::constant) return S(constant[left]);
  if constexpr (operation == Operation::add) return value[left] + value[right];
  if constexpr (operation == Operation::subtract) return value[left] - value[right];
  if constexpr (operation == Operation::multiply) return value[left] * value[right];
  if constexpr (operation == Operation::divide) return value[left] / value[right];
  if constexpr (operation == Operation::square_root) return sqrt(value[left]);
  if constexpr (operation == Operation::sine) return sin(value[left]);
  if constexpr (operation == Operation::cosine) return cos(value[left]);
}

/// Executes the steps from Begin on. In a list of initialisers, which are executed in order as well,
/// because compilers limit how many operands they fold; and in one function, because they optimise
/// what is inlined once more in each function that it passes through.
template <const auto& program, std::size_t Begin, class S, std::size_t... I>
[[gnu::always_inline]] inline void execute_steps([[maybe_unused]] S* value,
                                                 [[maybe_unused]] const S* input,
                                                 std::index_sequence<I...>) noexcept {
  constexpr const auto& steps = program.instructions;
  [[maybe_unused]] const bool done[] = {
      true, (value[Begin + I] = execute<steps[Begin + I].operation>(
                 value, input, program.constants, steps[Begin + I].left, steps[Begin + I].right),
             true)...};
}

/// Takes the sines and cosines that stand together.
template <const auto& program, class S, std::size_t... K>
[[gnu::always_inline]] inline void take_sines_and_cosines(S* value,
                                                          std::index_sequence<K...>) noexcept {
  if constexpr (sizeof...(K) > 0) {
    constexpr std::size_t begin = program.angles_begin;
    const std::array<S, sizeof...(K)> angle{value[program.instructions[begin + 2 * K].left]...};
    std::array<S, sizeof...(K)> sine, cosine;
    sine_cosine(angle, sine, cosine);
    ((value[begin + 2 * K] = sine[K], value[begin + 2 * K + 1] = cosine[K]), ...);
  }
}

/// The results of a program whose steps have been executed.
template <const auto& program, class S, std::size_t... I>
[[gnu::always_inline]] inline std::array<S, sizeof...(I)> results(
    const S* value, std::index_sequence<I...>) noexcept {
  return {(program.outputs[I].negative ? -value[program.outputs[I].value]
                                       : value[program.outputs[I].value])...};
}

}  // namespace detail

/// Runs a program.
/// @tparam program  a constexpr variable
/// @tparam S        double, float, a pack of them or another type with their operators
/// @param input     as many as the program was made for
/// @return          the results
/// Real-time: yes, if the operations of S are.
template <const auto& program, class S, std::size_t Inputs>
[[nodiscard, gnu::always_inline]] inline auto run_program(
    const std::array<S, Inputs>& input) noexcept {
  static_assert(program.is_whole());
  constexpr std::size_t begin = program.angles_begin, end = program.angles_end,
                        count = program.size.instructions;
  S value[count];  // NOLINT
  detail::execute_steps<program, 0>(value, input.data(), std::make_index_sequence<begin>{});
  detail::take_sines_and_cosines<program>(value, std::make_index_sequence<(end - begin) / 2>{});
  detail::execute_steps<program, end>(value, input.data(), std::make_index_sequence<count - end>{});
  return detail::results<program>(value, std::make_index_sequence<program.size.outputs>{});
}

}  // namespace articula::symbolic
