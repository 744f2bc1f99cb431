// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a controller, and the functions that call one.
#pragma once

#include "articula/core/control_input.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/outcome.hpp"

#include <concepts>
#include <utility>

namespace articula {

namespace detail {

template <class C, int N>
concept HasUpdate =
    requires(C& controller, const ControlInput<N>& input) { controller.update(input); };

template <class C, int N>
concept IsCallable = requires(C& controller, const ControlInput<N>& input) { controller(input); };

template <class C, int N>
concept HasStart =
    requires(C& controller, const ControlInput<N>& input) { controller.start(input); };

/// A type with a member `start` that does not take the input would never be started.
template <class C, int N>
concept StartFits = HasStart<C, N> || !requires { &C::start; };

/// Calls a controller: by its member `update`, or as a function.
template <class C, int N>
  requires HasUpdate<C, N> || IsCallable<C, N>
[[nodiscard]] constexpr decltype(auto) called(C& controller, const ControlInput<N>& input) {
  if constexpr (HasUpdate<C, N>) {
    return controller.update(input);
  } else {
    return controller(input);
  }
}

template <class C, int N>
[[nodiscard]] consteval bool update_is_noexcept() {
  if constexpr (HasUpdate<C, N>) {
    return noexcept(std::declval<C&>().update(std::declval<const ControlInput<N>&>()));
  } else {
    return noexcept(std::declval<C&>()(std::declval<const ControlInput<N>&>()));
  }
}

template <class C, int N>
[[nodiscard]] consteval bool start_is_noexcept() {
  if constexpr (HasStart<C, N>) {
    return noexcept(std::declval<C&>().start(std::declval<const ControlInput<N>&>()));
  } else {
    return true;
  }
}

/// The command in a result.
template <class Result>
struct CommandIn {
  using Type = Result;
};
template <class Command>
struct CommandIn<Outcome<Command>> {
  using Type = Command;
};

/// Cycles in a row without a call over which a controller's memory is kept.
inline constexpr int borne_cycles = 3;

}  // namespace detail

/// The kind of command of a controller for N joints.
template <class C, int N>
using CommandOf = typename detail::CommandIn<decltype(detail::called(
    std::declval<C&>(), std::declval<const ControlInput<N>&>()))>::Type;

/// A controller for N joints computes one command per cycle. The smallest is a function:
///
///     Loop loop{Q2dSim(), [](const ControlInput<2>& in) noexcept {
///       return EffortCommand<2>{5 * (in.reference.position - in.state.position)};
///     }};
///
/// One with gains or memory is a struct:
///
/// - `update(const ControlInput<N>&)` gives the command for the coming period, or an Outcome: a
///   command with a verdict.
/// - `start(const ControlInput<N>&)`, if there is one, forgets the past, so that the next command
///   does not depend on it. With a command in `input.applied` that reached the drives, integrals
///   begin with it; without one it is a cold start. A controller without memory has no `start`.
/// - `brake(const ControlInput<N>&)`, if there is one, brakes the joints: see Brakes.
///
/// The caller guarantees that state, reference and period are finite and the period is positive;
/// no controller checks them. (`brake` alone is called with a reference that is not finite.) Up to
/// three consecutive cycles without a call leave the controller's memory valid. After more, the
/// caller starts it again.
///
/// All functions are noexcept and must not allocate, lock or call the system: they run in the
/// control loop. Do not write a controller for a sum of terms, for limits, or for several control
/// modes: see SumController, Limited and Switch.
/// @tparam C  the controller
/// @tparam N  number of joints
template <class C, int N>
concept Controller = (detail::HasUpdate<C, N> || detail::IsCallable<C, N>) &&
                     detail::update_is_noexcept<C, N>() && JointCommand<CommandOf<C, N>, N> &&
                     detail::StartFits<C, N> && detail::start_is_noexcept<C, N>();

/// A controller that can brake the joints within limits where the reference is not finite, as
/// Limited does: `brake(input)` gives the braking command. It has failed where the part that is
/// active cannot brake. Controllers without `brake` are not called in such a cycle.
template <class C, int N>
concept Brakes = requires(C& controller, const ControlInput<N>& input) {
  { controller.brake(input) } noexcept;
};

/// Starts a controller, if it has a `start`. Real-time: yes, if that is.
/// @param input  with no cut
template <class C, int N>
void start_controller(C& controller, const ControlInput<N>& input) noexcept {
  if constexpr (detail::HasStart<C, N>) controller.start(input);
}

/// Calls a controller for the command of the coming period. Real-time: yes, if its `update` is.
template <class C, int N>
[[nodiscard]] Outcome<CommandOf<C, N>> update_controller(C& controller,
                                                         const ControlInput<N>& input) noexcept {
  return detail::called(controller, input);
}

/// Lets a controller brake the joints. Real-time: yes, if its `brake` is.
/// @param input  its reference need not be finite
/// @return       a failed outcome if the controller cannot brake
template <class C, int N>
[[nodiscard]] Outcome<CommandOf<C, N>> brake_controller(C& controller,
                                                        const ControlInput<N>& input) noexcept {
  if constexpr (Brakes<C, N>) {
    return controller.brake(input);
  } else {
    return {};
  }
}

}  // namespace articula
