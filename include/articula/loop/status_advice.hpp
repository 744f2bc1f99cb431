// SPDX-License-Identifier: Apache-2.0
/// @file The cause and cure of each status in a sentence.
#pragma once

#include "articula/core/status.hpp"

#include <string_view>

namespace articula {

/// Cause and cure of a status, for those who operate a robot. docs/troubleshooting.md says more.
/// Real-time: yes.
[[nodiscard]] constexpr std::string_view advice_on(Status status) noexcept {
  switch (status) {
    case Status::ok:
      return "";
    case Status::non_finite_state:
      return "The hardware returned NaN or infinity: check sensors and codec, or reset the "
             "simulation.";
    case Status::non_finite_reference:
      return "The reference contains NaN or infinity: check the source of references.";
    case Status::non_finite_command:
      return "The controller returned NaN or infinity, or reported a failure: look at the list of "
             "controllers, and lower the gains that were changed last.";
    case Status::hardware_fault:
      return "The hardware could not be read, written, activated or deactivated: check power, "
             "cable "
             "and bus, and read its fault.";
    case Status::stale_state:
      return "A joint's measurement is too old: check the load of the bus and the period.";
    case Status::stale_reference:
      return "No new reference came within its lifetime: post references more often, or set "
             "reference_lifetime.";
    case Status::limit_exceeded:
      return "A joint is beyond its position or velocity limit: bring it back, and check the "
             "limits "
             "of the description.";
    case Status::overrun:
      return "Too many cycles took longer than the period: stop other programs, or measure the "
             "machine with benchmarks/jitter.";
    case Status::inactive:
      return "The loop or its hardware is not active: activate it.";
  }
  return "";
}

}  // namespace articula
