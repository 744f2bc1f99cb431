// SPDX-License-Identifier: Apache-2.0
/// @file The result of a cycle of the loop.
#pragma once

#include <string_view>

namespace articula {

/// The result of one cycle of the loop, or of one access to the hardware. The hardware has a safe
/// command in every case.
enum class [[nodiscard]] Status : unsigned char {
  ok,                    ///< Success, also with commands at their limits.
  non_finite_state,      ///< A measured position, velocity or effort is NaN or infinite.
  non_finite_reference,  ///< A member of the reference is NaN or infinite.
  non_finite_command,    ///< The controller computed a NaN or infinity, or reports failure.
  hardware_fault,        ///< The hardware could not be read, written, activated or deactivated.
  stale_state,           ///< A joint's measurement is older than it may be.
  stale_reference,       ///< No new reference came within the lifetime of the last one.
  limit_exceeded,        ///< A joint is measured beyond its position or velocity limit.
  overrun,               ///< Too many cycles ended after the next one was due.
  inactive,  ///< The loop or its hardware is not active: it measures, and does not control.
};

/// The status in words, for messages and logs.
/// Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(Status status) noexcept {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::non_finite_state:
      return "non-finite state";
    case Status::non_finite_reference:
      return "non-finite reference";
    case Status::non_finite_command:
      return "non-finite command";
    case Status::hardware_fault:
      return "hardware fault";
    case Status::stale_state:
      return "stale state";
    case Status::stale_reference:
      return "stale reference";
    case Status::limit_exceeded:
      return "limit exceeded";
    case Status::overrun:
      return "overrun";
    case Status::inactive:
      return "inactive";
  }
  return "unknown status";
}

}  // namespace articula
