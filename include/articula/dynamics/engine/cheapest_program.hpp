// SPDX-License-Identifier: Apache-2.0
/// @file The choice of the cheapest program of an algorithm for a described robot.
#pragma once

#include "articula/dynamics/engine/algorithm_traits.hpp"
#include "articula/dynamics/engine/gravity_efforts.hpp"
#include "articula/dynamics/engine/trace.hpp"

namespace articula::compiled {

namespace detail {

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

}  // namespace detail

/// The program of an algorithm for a robot.
template <class Algorithm, DescribedRobot R>
inline constexpr const auto& program = detail::cheapest_program<Algorithm, R>();

}  // namespace articula::compiled
