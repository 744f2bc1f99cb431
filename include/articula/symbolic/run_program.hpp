// SPDX-License-Identifier: Apache-2.0
/// @file Execution of straight-line programs for any scalar.
#pragma once

#include "articula/symbolic/program.hpp"
#include "articula/symbolic/sine_cosine.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace articula::symbolic {

namespace detail {

/// Computes one step of a program. The numbers of the operands are constants for the optimiser,
/// which keeps the values in registers. (There are few parameters, and template arguments are
/// explicit, because compilers spend time on each, a thousand times.)
/// @param value   values before this step; not const, because the others are not initialised yet
/// @param number  of the step
template <const auto& program, Operation operation, class S, class Input>
[[gnu::always_inline]] inline S execute(S* value, const Input& input, std::size_t number) noexcept {
  using std::cos, std::sin, std::sqrt;
  const Instruction& step = program.instructions[number];
  if constexpr (operation == Operation::input) return input[step.left];
  if constexpr (operation == Operation::constant) return S(program.constants[step.left]);
  if constexpr (operation == Operation::add) return value[step.left] + value[step.right];
  if constexpr (operation == Operation::subtract) return value[step.left] - value[step.right];
  if constexpr (operation == Operation::multiply) return value[step.left] * value[step.right];
  if constexpr (operation == Operation::divide) return value[step.left] / value[step.right];
  if constexpr (operation == Operation::square_root) return sqrt(value[step.left]);
  if constexpr (operation == Operation::sine) return sin(value[step.left]);
  if constexpr (operation == Operation::cosine) return cos(value[step.left]);
}

/// Computes the adjacent sines and cosines.
/// @param value  values before them
/// @param taken  receives sines and cosines in turn
/// @return       the first sine
template <const auto& program, class S, std::size_t... Angle>
[[gnu::always_inline]] inline S take_angles(S* value, S* taken,
                                            std::index_sequence<Angle...>) noexcept {
  constexpr std::size_t begin = program.angles_begin;
  const std::array<S, sizeof...(Angle)> angle{
      value[program.instructions[begin + 2 * Angle].left]...};
  std::array<S, sizeof...(Angle)> sine, cosine;
  sine_cosine(angle, sine, cosine);
  ((taken[2 * Angle] = sine[Angle], taken[2 * Angle + 1] = cosine[Angle]), ...);
  return taken[0];
}

/// Executes the steps before the angles, the angles, and the steps after them. Each value is
/// computed from preceding values in the same list of initialisers, which run in order. (Compilers
/// take twice as long for a fold of assignments, and limit its length.) The first sine computes all
/// adjacent sines and cosines. For example, the program of 2 cos(x) + x becomes
///
///     S value[] = {input[0],                          // Before: x
///                  take_angles(value, taken),         // SineOrCosine 0: sin(x)
///                  taken[1],                          // SineOrCosine 1: cos(x)
///                  S(2.0),                            // After
///                  value[3] * value[2],
///                  value[0] + value[4]};
///     return {value[5]};
template <const auto& program, class S, class Input, std::size_t... Before,
          std::size_t... SineOrCosine, std::size_t... After, std::size_t... Result>
[[gnu::always_inline]] inline std::array<S, sizeof...(Result)> execute_steps(
    [[maybe_unused]] const Input& input, std::index_sequence<Before...>,
    std::index_sequence<SineOrCosine...>, std::index_sequence<After...>,
    std::index_sequence<Result...>) noexcept {
  constexpr const auto& steps = program.instructions;
  constexpr std::size_t end = program.angles_end;
  [[maybe_unused]] constexpr std::make_index_sequence<sizeof...(SineOrCosine) / 2> angles;
  // NOLINTNEXTLINE: one more, as no array may be empty
  [[maybe_unused]] S taken[sizeof...(SineOrCosine) + 1];
  // NOLINTNEXTLINE: compilers read plain arrays faster than std::array
  S value[] = {
      execute<program, steps[Before].operation, S, Input>(value, input, Before)...,
      (SineOrCosine == 0 ? take_angles<program, S>(value, taken, angles) : taken[SineOrCosine])...,
      execute<program, steps[end + After].operation, S, Input>(value, input, end + After)...};
  return {(program.outputs[Result].negative ? -value[program.outputs[Result].value]
                                            : value[program.outputs[Result].value])...};
}

}  // namespace detail

/// Runs a program.
/// @tparam program  a constexpr variable
/// @param input     input[i] is input number i: a double, a float, a pack of them or another type
///                  with their operators and a default constructor
/// @return          the results
/// Real-time: yes, if the operations of that type are.
template <const auto& program, class Input>
[[nodiscard, gnu::always_inline]] inline auto run_program(const Input& input) noexcept {
  using S = std::remove_cvref_t<decltype(input[0])>;
  static_assert(program.is_complete());
  static_assert(program.size.outputs > 0, "articula: this program has no results");
  constexpr std::size_t begin = program.angles_begin, end = program.angles_end;
  return detail::execute_steps<program, S>(
      input, std::make_index_sequence<begin>{}, std::make_index_sequence<end - begin>{},
      std::make_index_sequence<program.size.instructions - end>{},
      std::make_index_sequence<program.size.outputs>{});
}

}  // namespace articula::symbolic
