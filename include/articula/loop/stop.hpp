// SPDX-License-Identifier: Apache-2.0
/// @file The end of control: a last safe command, then deactivation.
#pragma once

#include "articula/control/safety/safe_command.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/status.hpp"

namespace articula {

/// Ends control: writes one more safe command and deactivates the hardware. After a good cycle the
/// command is the one that holds (see safe_command). After a bad one it is the safe command that
/// the loop found for it. A loop that has its own `stop()`, such as SupervisedLoop, does that
/// instead.
/// @param loop    a Loop, or something like it
/// @param status  of its last update
/// @return        the first thing that went wrong
/// Real-time: no (deactivation may take its time).
template <class LoopType>
[[nodiscard]] Status stop(LoopType& loop, Status status) {
  if constexpr (requires { loop.stop(); }) {
    return loop.stop();
  } else {
    auto& hardware = loop.hardware();
    const auto last = status == Status::ok
                          ? safe_command(hardware.robot(), loop.state().position, loop.command())
                          : loop.command();
    const Status written = all_of(is_finite(last)) ? hardware.write(last) : Status::ok;
    const Status deactivated = hardware.deactivate();
    return written == Status::ok ? deactivated : written;
  }
}

}  // namespace articula
