// SPDX-License-Identifier: Apache-2.0
/// @file Robots of one kind with different numbers: the kind, and which of its numbers are inputs.
#pragma once

#include "articula/dynamics/engine/body_numbers.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cstddef>
#include <type_traits>

namespace articula {

/// A described robot whose programs take the bodies' numbers as inputs. These are the numbers of
/// the canonical mechanism that are not 0 in the description of R. The tree, the directions of the
/// axes and all zeros stay known to the compiler. So such a program is hardly longer than that of
/// R. For example `operations<ForwardDynamics, WithInputNumbers<Q2d>>().multiplications`.
template <DescribedRobot R>
struct WithInputNumbers {
  using Nominal = R;
  static constexpr const auto& description = R::description;
};

namespace detail {

/// The same model; it is compiled once.
template <DescribedRobot R>
inline constexpr const auto& compiled_model<WithInputNumbers<R>> = compiled_model<R>;

template <class R>
inline constexpr bool has_input_numbers = false;
template <class R>
inline constexpr bool has_input_numbers<WithInputNumbers<R>> = true;

/// Whether each number of each body is an input.
template <DescribedRobot R>
[[nodiscard]] consteval auto input_mask() {
  constexpr int bodies = std::remove_cvref_t<decltype(model_of(R{}))>::body_count;
  std::array<bool, std::size_t{bodies} * std::size_t{BodyNumbers<double>::count}> mask{};
  std::size_t next = 0;
  for (const Body& body : model_of(R{}).canonical.bodies) {
    const auto numbers = numbers_of<double>(body);
    for_each_number(numbers, [&](double number) { mask[next++] = number != 0; });
  }
  return mask;
}

/// How many numbers are inputs.
template <DescribedRobot R>
[[nodiscard]] consteval int input_count() {
  int count = 0;
  for (const bool is_input : input_mask<R>()) count += is_input ? 1 : 0;
  return count;
}

}  // namespace detail

}  // namespace articula
