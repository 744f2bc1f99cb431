// SPDX-License-Identifier: Apache-2.0
/// @file Straight-line programs for the algorithms of described robots.
#pragma once

#include "articula/dynamics/engine/configuration.hpp"
#include "articula/dynamics/engine/gravity_efforts.hpp"
#include "articula/dynamics/engine/input_numbers.hpp"
#include "articula/model/robot.hpp"
#include "articula/symbolic/assembler.hpp"
#include "articula/symbolic/run_program.hpp"
#include "articula/symbolic/scalars.hpp"
#include "articula/symbolic/symbol.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace articula::compiled {

/// True for algorithms whose result depends on the frames of the bodies or on the distribution of
/// inertia among them. Such an algorithm has a member `needs_own_frames` and runs on the mechanism
/// as described; the others run on its canonical form.
template <class Algorithm>
inline constexpr bool needs_own_frames = requires { requires Algorithm::needs_own_frames; };

/// True for algorithms of kinematics, which also run for robots without masses. Such an algorithm
/// has a member `needs_no_masses`.
template <class Algorithm>
inline constexpr bool needs_no_masses = requires { requires Algorithm::needs_no_masses; };

/// Rejects an algorithm of dynamics for a robot without masses, at compile time.
template <class Algorithm, Robot R>
consteval void check_masses() {
  if constexpr (!needs_no_masses<Algorithm>) {
    static_assert(articula::detail::has_masses<R, Algorithm>);
  }
}

/// An algorithm about one link, named at compile time. It takes the robot's model and the joint
/// positions: `evaluate<frames, S>(model, q)`.
template <class Algorithm>
concept LinkAlgorithm = requires { Algorithm::link; };

/// The mechanism of a robot on which an algorithm runs. Real-time: yes.
template <class Algorithm, Robot R>
[[nodiscard]] constexpr const auto& mechanism_for(const R& robot) noexcept {
  if constexpr (needs_own_frames<Algorithm>) {
    return model_of(robot).mechanism;
  } else {
    return model_of(robot).canonical;
  }
}

namespace detail {

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
/// numbered through the positions, then through the algorithm's other arrays, see Concatenated, then
/// through the numbers of the bodies that are inputs.
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

/// The program of an algorithm in the stated frames.
template <class Algorithm, DescribedRobot R, Frames frames>
inline constexpr auto program_in = compile<Algorithm, R, frames>();

/// The cost that resting frames save in an algorithm's program.
template <class Algorithm, DescribedRobot R>
inline constexpr int gain_of_resting =
    program_in<Algorithm, R, Frames::moving>.operations().cost() -
    program_in<Algorithm, R, Frames::resting>.operations().cost();

/// The frames that give the cheaper program. To compile each algorithm in both would take longer
/// than everything else. So the gravity efforts decide for all algorithms: their program is short
/// and consists of the operations on which the frames have an effect. Where gravity costs the same
/// in both, as with vertical axes, the algorithm itself decides. It also decides for a link's
/// algorithm, which has other operations.
template <class Algorithm, DescribedRobot R>
[[nodiscard]] consteval Frames frames_for() {
  if constexpr (needs_own_frames<Algorithm>) {
    return Frames::moving;
  } else if constexpr (LinkAlgorithm<Algorithm>) {
    return gain_of_resting<Algorithm, R> > 0 ? Frames::resting : Frames::moving;
  } else if constexpr (gain_of_resting<Gravity, R> != 0) {
    return gain_of_resting<Gravity, R> > 0 ? Frames::resting : Frames::moving;
  } else {
    return gain_of_resting<Algorithm, R> > 0 ? Frames::resting : Frames::moving;
  }
}

/// The program of an algorithm in the better frames.
template <class Algorithm, DescribedRobot R>
inline constexpr const auto& best_program = program_in<Algorithm, R, frames_for<Algorithm, R>()>;

/// Whether an algorithm has an `Alternative`, another one with the same inputs and results, that
/// gives a cheaper program. It is compiled only where its `may_pay` is true.
template <class Algorithm, DescribedRobot R>
[[nodiscard]] consteval bool has_cheaper_alternative() {
  if constexpr (requires { typename Algorithm::Alternative; }) {
    using Other = typename Algorithm::Alternative;
    if constexpr (Other::may_pay(mechanism_for<Algorithm>(R{}))) {
      return best_program<Other, R>.operations().cost() <
             best_program<Algorithm, R>.operations().cost();
    }
  }
  return false;
}

template <class Algorithm, DescribedRobot R>
[[nodiscard]] consteval const auto& cheapest_program() {
  check_masses<Algorithm, R>();
  if constexpr (has_cheaper_alternative<Algorithm, R>()) {
    return best_program<typename Algorithm::Alternative, R>;
  } else {
    return best_program<Algorithm, R>;
  }
}

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

/// The program of an algorithm for a robot.
template <class Algorithm, DescribedRobot R>
inline constexpr const auto& program = detail::cheapest_program<Algorithm, R>();

/// Runs an algorithm's program. The result is that of Algorithm::evaluate for the robot's mechanism
/// up to rounding. Where axes are parallel, their angles are added. That has the effect of an error
/// of some units in the last place of an angle, 2e-9 rad each at 1e7 rad. Inputs on which the result
/// does not depend are not read, so a NaN there has no effect.
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
