// SPDX-License-Identifier: Apache-2.0
/// @file Straight-line programs for the algorithms of described robots.
#pragma once

#include "articula/dynamics/engine/algorithm_traits.hpp"
#include "articula/dynamics/engine/cheapest_program.hpp"
#include "articula/dynamics/engine/configuration.hpp"
#include "articula/dynamics/engine/input_numbers.hpp"
#include "articula/symbolic/run_program.hpp"
#include "articula/symbolic/scalars.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace articula::compiled {

namespace detail {

/// Arrays of N numbers as one array, in which inputs are numbered as in `trace`.
template <class Array, std::size_t N, std::size_t Arrays>
struct Concatenated {
  const Array* arrays[Arrays];  // NOLINT

  [[gnu::always_inline]] auto operator[](std::size_t i) const noexcept {
    return (*arrays[i / N])[i % N];
  }
};

/// The same with the numbers of the bodies after the arrays.
template <class Array, class Number, std::size_t N, std::size_t Arrays>
struct ConcatenatedWithNumbers {
  Concatenated<Array, N, Arrays> arrays;
  const Number* numbers;

  [[gnu::always_inline]] auto operator[](std::size_t i) const noexcept {
    using S = std::remove_cvref_t<decltype(arrays[i])>;
    return i < N * Arrays ? arrays[i] : S(numbers[i - N * Arrays]);
  }
};

/// The result type of an algorithm for the scalar S.
template <class Algorithm, DescribedRobot R, class S, class... Inputs>
struct Result {
  static constexpr int n = ModelOf<R>::joint_count, b = ModelOf<R>::body_count;
  using Type = decltype(Algorithm::template evaluate<S, n, b>(
      std::declval<Mechanism<n, b>>(), std::declval<Configuration<S, b>>(),
      std::declval<std::conditional_t<true, JointArray<S, n>, Inputs>>()...));
};
template <LinkAlgorithm Algorithm, DescribedRobot R, class S>
struct Result<Algorithm, R, S> {
  using Type = decltype(Algorithm::template evaluate<Frames::moving, S>(
      model_of(R{}), std::declval<JointArray<S, ModelOf<R>::joint_count>>()));
};

/// The results of a program in the shape of the algorithm's result.
template <class Algorithm, DescribedRobot R, class S, class... Inputs, std::size_t Count>
[[nodiscard, gnu::always_inline]] inline auto shaped(const std::array<S, Count>& output) noexcept {
  typename Result<Algorithm, R, S, Inputs...>::Type result;
  std::size_t next = 0;
  symbolic::for_each_scalar<S>(
      result, [&](S& value) __attribute__((always_inline)) { value = output[next++]; });
  return result;
}

}  // namespace detail

/// Runs an algorithm's program. The result is that of Algorithm::evaluate for the robot's mechanism
/// up to rounding. Where axes are parallel, their angles are added. That has the effect of an error
/// of some units in the last place of an angle, 2e-9 rad each at 1e7 rad. Inputs on which the
/// result does not depend are not read, so a NaN there has no effect.
/// @param q       joint positions [rad or m]: q[i] is that of joint i, a number or a pack. An array
///                or a pointer to N numbers
/// @param inputs  the algorithm's other inputs, of the same type
/// Real-time: yes.
template <class Algorithm, DescribedRobot R, class Input, std::same_as<Input>... Inputs>
[[nodiscard, gnu::always_inline]] inline auto run(const Input& q,
                                                  const Inputs&... inputs) noexcept {
  using S = std::remove_cvref_t<decltype(q[0])>;
  constexpr int n = detail::ModelOf<R>::joint_count;
  if constexpr (requires { std::tuple_size<Input>::value; }) {
    static_assert(std::tuple_size_v<Input> == n, "articula: there are as many numbers as joints");
  }
  const detail::Concatenated<Input, std::size_t{n}, 1 + sizeof...(Inputs)> input{{&q, &inputs...}};
  return detail::shaped<Algorithm, R, S, Inputs...>(
      symbolic::run_program<program<Algorithm, R>>(input));
}

/// The same for a robot of the kind of R whose bodies have other numbers.
/// @param numbers  those that are inputs, in the order of `for_each_number`: doubles, or as q
/// Real-time: yes.
template <class Algorithm, DescribedRobot R, class Number, class Input,
          std::same_as<Input>... Inputs>
[[nodiscard, gnu::always_inline]] inline auto run_with(const Number* numbers, const Input& q,
                                                       const Inputs&... inputs) noexcept {
  using S = std::remove_cvref_t<decltype(q[0])>;
  using Kind = WithInputNumbers<R>;
  constexpr auto n = std::size_t{detail::ModelOf<R>::joint_count};
  const detail::ConcatenatedWithNumbers<Input, Number, n, 1 + sizeof...(Inputs)> input{
      {{&q, &inputs...}}, numbers};
  return detail::shaped<Algorithm, R, S, Inputs...>(
      symbolic::run_program<program<Algorithm, Kind>>(input));
}

}  // namespace articula::compiled

namespace articula {

/// The number of operations in the program of an algorithm; `sines` counts pairs of sine and
/// cosine. For example `operations<InverseDynamics, Q2d>().multiplications`.
template <class Algorithm, DescribedRobot R>
[[nodiscard]] consteval symbolic::OperationCounts operations() {
  return compiled::program<Algorithm, R>.operations();
}

}  // namespace articula
