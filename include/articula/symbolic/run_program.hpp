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

/// Computes what one step of a program says. The numbers of the operands are constants to the
/// optimiser, which keeps the values in registers. (Compilers take their time for each argument, to
/// be deduced or passed, a thousand times: so there are few, and those of the template are given.)
/// @param value   those before this step; not const, because the others have no value yet
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

/// Takes the sines and cosines that stand together.
/// @param value  those before them
/// @param taken  receives sines and cosines by turns
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
/// computed from those before it in the same list of initialisers, which are executed in order:
/// compilers take twice as long for a fold of assignments, and limit its length. The first sine
/// takes all sines and cosines; those that follow in the list find theirs taken. The program of
/// 2 cos(x) + x, say, becomes
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
/// @param input     input[i] is input number i, read when it is needed: a double, float, a pack of
///                  them or another type that has their operators and can be made without a value
/// @return          the results
/// Real-time: yes, if the operations of that type are.
template <const auto& program, class Input>
[[nodiscard, gnu::always_inline]] inline auto run_program(const Input& input) noexcept {
  using S = std::remove_cvref_t<decltype(input[0])>;
  static_assert(program.is_whole());
  static_assert(program.size.outputs > 0, "articula: this program has no results");
  constexpr std::size_t begin = program.angles_begin, end = program.angles_end;
  return detail::execute_steps<program, S>(
      input, std::make_index_sequence<begin>{}, std::make_index_sequence<end - begin>{},
      std::make_index_sequence<program.size.instructions - end>{},
      std::make_index_sequence<program.size.outputs>{});
}

}  // namespace articula::symbolic
