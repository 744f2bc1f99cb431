// SPDX-License-Identifier: Apache-2.0
/// @file The period of a loop, and the activation of its hardware.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/core/status.hpp"

#include <optional>
#include <stdexcept>
#include <string>

namespace articula::detail {

/// The time between two updates of a loop [s]: the hardware's own, else the one that is asked for,
/// else 1 ms.
/// @throws std::invalid_argument if it is not a positive number, or not that which the hardware
///         dictates
template <class HardwareType>
[[nodiscard]] double loop_period(const HardwareType& hardware, std::optional<double> asked) {
  double period = asked.value_or(1e-3);
  if constexpr (requires { hardware.period(); }) period = hardware.period();
  if (!is_finite(period) || period <= 0) {
    refuse({"loop: period ", period, " s is not a positive number"});
  }
  if (asked && *asked != period) {
    refuse({"loop: period ", *asked, " s, but the hardware has ", period,
            " s; leave the loop's period out, or set the hardware's"});
  }
  return period;
}

/// Activates hardware that a loop has taken. It ends with the exception, so the exception tells its
/// fault.
/// @throws std::runtime_error if the hardware cannot be activated
template <class HardwareType>
void activate(HardwareType& hardware) {
  const Status status = hardware.activate();
  if (status == Status::ok) return;
  std::string fault(to_string(status));
  if constexpr (requires { fault = describe(hardware.fault()); })
    fault = describe(hardware.fault());
  throw std::runtime_error("loop: the hardware cannot be activated: " + fault +
                           " (see docs/hardware.md)");
}

}  // namespace articula::detail
