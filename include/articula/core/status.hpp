// SPDX-License-Identifier: Apache-2.0
/// @file How a cycle ended.
#pragma once

#include <string_view>

namespace articula {

/// How one cycle of the loop, or one access to the hardware, ended. Whatever it says, the hardware
/// was left with a safe command.
enum class [[nodiscard]] Status : unsigned char {
  ok,                    ///< All went as asked; an effort held at its limit is still ok.
  non_finite_state,      ///< A measured position, velocity or effort is NaN or infinite.
  non_finite_reference,  ///< A member of the reference is NaN or infinite.
  non_finite_command,    ///< The controller computed a NaN or infinity, or says that it failed.
  hardware_fault,        ///< The hardware could not be read, written, activated or deactivated.
  stale_state,           ///< A joint's measurement is older than it may be.
  stale_reference,       ///< No new reference came within the lifetime of the last one.
  limit_exceeded,        ///< A joint is measured beyond its position or velocity limit.
  overrun,               ///< Too many cycles ended after the next one was due.
  inactive,  ///< The loop or its hardware is not active: it watches, and does not control.
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
