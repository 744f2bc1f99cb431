// SPDX-License-Identifier: Apache-2.0
/// @file Controllers that tell when they cannot control.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_vector.hpp"

#include <concepts>
#include <limits>

namespace articula {

/// A controller that can tell, after `update`, that it cannot control: its command does not count.
template <class C>
concept TellsFailure = requires(const C& controller) {
  { controller.failed() } noexcept -> std::same_as<bool>;
};

/// One whose command, if it is finite, counts even then, because it is a safe one: a member
/// `safe_in_failure` says so. Such are Limited, which brakes, Groups, of which the other groups go
/// on, and a Switch of these.
template <class C>
concept SafeInFailure = TellsFailure<C> && C::safe_in_failure;

/// One that is asked even where the reference is not finite, because it brakes the joints within
/// limits then: a member `brakes_without_reference` says so. Such are Limited, and a Switch or
/// Groups that contain such. All others may count on a finite reference.
template <class C>
concept BrakesWithoutReference = C::brakes_without_reference;

/// Whether a controller says that it has failed. Real-time: yes.
template <class C>
[[nodiscard]] bool has_failed(const C& controller) noexcept {
  if constexpr (TellsFailure<C>) {
    return controller.failed();
  } else {
    return false;
  }
}

/// Whether a controller's last command, if it is finite, may be passed on. Real-time: yes.
template <class C>
[[nodiscard]] bool command_counts(const C& controller) noexcept {
  return SafeInFailure<C> || !has_failed(controller);
}

/// What is returned in place of a command: one that is not finite. Real-time: yes.
template <class Command>
[[nodiscard]] Command no_command() noexcept {
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto nothing = JointVector<Command::joint_count>::Constant(not_a_number);
  if constexpr (requires(Command command) { command.effort; }) {
    return {.effort = nothing};
  } else {
    return {nothing};
  }
}

}  // namespace articula
