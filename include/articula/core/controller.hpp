// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a controller, to write one of your own, and its calls by a loop.
#pragma once

#include "articula/core/control_input.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/outcome.hpp"

#include <concepts>
#include <utility>

namespace articula {

namespace detail {

template <class C, int N, class S = double>
concept HasUpdate =
    requires(C& controller, const ControlInput<N, S>& input) { controller.update(input); };

template <class C, int N, class S = double>
concept IsCallable =
    requires(C& controller, const ControlInput<N, S>& input) { controller(input); };

template <class C, int N, class S = double>
concept HasStart =
    requires(C& controller, const ControlInput<N, S>& input) { controller.start(input); };

/// A type with a member `start` that does not take the input would never be started.
template <class C, int N, class S = double>
concept StartFits = HasStart<C, N, S> || !requires { &C::start; };

/// Calls a controller: by its member `update`, or as a function.
template <class C, int N, class S>
  requires HasUpdate<C, N, S> || IsCallable<C, N, S>
[[nodiscard]] constexpr decltype(auto) called(C& controller, const ControlInput<N, S>& input) {
  if constexpr (HasUpdate<C, N, S>) {
    return controller.update(input);
  } else {
    return controller(input);
  }
}

template <class C, int N, class S = double>
[[nodiscard]] consteval bool update_is_noexcept() {
  if constexpr (HasUpdate<C, N, S>) {
    return noexcept(std::declval<C&>().update(std::declval<const ControlInput<N, S>&>()));
  } else {
    return noexcept(std::declval<C&>()(std::declval<const ControlInput<N, S>&>()));
  }
}

template <class C, int N, class S = double>
[[nodiscard]] consteval bool start_is_noexcept() {
  if constexpr (HasStart<C, N, S>) {
    return noexcept(std::declval<C&>().start(std::declval<const ControlInput<N, S>&>()));
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

/// The outcome of a call. The command of an Outcome may have changed since that was made, so it is
/// looked at once more.
template <class Command>
[[nodiscard]] Outcome<Command> checked(const Command& command) noexcept {
  return command;
}
template <class Command>
[[nodiscard]] Outcome<Command> checked(const Outcome<Command>& outcome) noexcept {
  return {outcome.command, outcome.verdict};
}

/// Cycles in a row without a call over which a controller's memory is kept.
inline constexpr int borne_cycles = 3;

}  // namespace detail

/// The kind of command of a controller for N joints.
template <class C, int N, class S = double>
using CommandOf = typename detail::CommandIn<decltype(detail::called(
    std::declval<C&>(), std::declval<const ControlInput<N, S>&>()))>::Type;

/// A controller for N joints computes one command in each cycle from the measured state and the
/// reference. Write one where the ready controllers do not contain your equation. The smallest is a
/// function:
///
///     Loop loop{Q2dSim(), [](const ControlInput<2>& in) noexcept {
///       return EffortCommand<2>{5 * (in.reference.position - in.state.position)};
///     }};
///
/// One with gains or memory is a struct:
///
/// - `update(const ControlInput<N>&)` returns the command for the coming period. It may return an
///   Outcome instead: a command with a verdict.
/// - `start(const ControlInput<N>&)`, if there is one, forgets the past. The next command does not
///   depend on it. If `input.applied` has a command that reached the drives, integrals begin with
///   that command. Without one, it is a cold start. A controller without memory has no `start`.
/// - `brake(const ControlInput<N>&)`, if there is one, brakes the joints: see Brakes.
///
/// The caller guarantees that state, reference and period are finite, and that the period is
/// positive, so a controller need not check them. JointPid does, as it is used without a loop, too.
/// Only `brake` is called with a reference that is not finite.
/// Up to three consecutive cycles without a call leave the controller's memory valid. After more,
/// the caller starts the controller again.
///
/// All functions are noexcept. They run in the control loop, so they must not allocate, lock or
/// call the system. Do not write a controller for a sum of terms, for limits, or for several
/// control modes: use SumController, Limited and Switch.
/// @tparam C  the controller
/// @tparam N  number of joints
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <class C, int N, class S = double>
concept Controller =
    (detail::HasUpdate<C, N, S> || detail::IsCallable<C, N, S>) &&
    detail::update_is_noexcept<C, N, S>() && JointCommand<CommandOf<C, N, S>, N, S> &&
    detail::StartFits<C, N, S> && detail::start_is_noexcept<C, N, S>();

/// A controller that can brake the joints within limits while the reference is not finite. Example:
/// Limited. `brake(input)` returns the braking command, or a failed outcome if the active part
/// cannot brake. A controller without `brake` is not called in such a cycle.
template <class C, int N, class S = double>
concept Brakes = requires(C& controller, const ControlInput<N, S>& input) {
  { controller.brake(input) } noexcept -> std::convertible_to<Outcome<CommandOf<C, N, S>>>;
};

namespace detail {

/// A type with a member `brake` that does not fit would never be asked to brake.
template <class C, int N, class S = double>
concept BrakeFits = Brakes<C, N, S> || !requires { &C::brake; };

}  // namespace detail

/// Starts a controller, if it has a `start`. Real-time: yes, if that is.
/// @param input  with no cut
template <class C, int N, class S>
void start_controller(C& controller, const ControlInput<N, S>& input) noexcept {
  if constexpr (detail::HasStart<C, N, S>) controller.start(input);
}

/// Calls a controller for the command of the coming period. Real-time: yes, if its `update` is.
template <class C, int N, class S>
[[nodiscard]] Outcome<CommandOf<C, N, S>> update_controller(
    C& controller, const ControlInput<N, S>& input) noexcept {
  return detail::checked(detail::called(controller, input));
}

/// Lets a controller brake the joints. Real-time: yes, if its `brake` is.
/// @param input  its reference need not be finite
/// @return       a failed outcome if the controller cannot brake
template <class C, int N, class S>
[[nodiscard]] Outcome<CommandOf<C, N, S>> brake_controller(
    C& controller, const ControlInput<N, S>& input) noexcept {
  if constexpr (Brakes<C, N, S>) {
    return detail::checked(controller.brake(input));
  } else {
    return {};
  }
}

}  // namespace articula
