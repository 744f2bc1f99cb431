// SPDX-License-Identifier: Apache-2.0
/// @file Hardware that paces the loop.
#pragma once

#include "articula/core/hardware.hpp"
#include "articula/loop/loop_clock.hpp"

#include <chrono>

namespace articula {

/// A clock that lets hardware pace the loop: cycles begin when the bus's own cycle arrives. Where it
/// does not arrive within half a period, the loop's cycle begins without it, so that the loop can
/// notice and be safe.
/// @tparam HardwareType  satisfies PacingHardware
/// @tparam Base          tells the time and waits where the hardware fails to
template <PacingHardware HardwareType, LoopClock Base>
class HardwareClock {
 public:
  /// @param hardware  outlives the clock
  /// @param base      outlives the clock
  /// @param period    of the loop [s]
  HardwareClock(HardwareType& hardware, Base& base, double period)
      : hardware_(&hardware),
        base_(&base),
        patience_(std::chrono::nanoseconds(
            static_cast<std::chrono::nanoseconds::rep>(period * 1e9 / 2))) {}

  /// Real-time: yes, if the base clock's is.
  [[nodiscard]] std::chrono::nanoseconds now() noexcept { return base_->now(); }

  /// Waits for the hardware's next cycle.
  /// @param due  when it is expected
  /// @return     when it arrived, or when patience ended
  /// Real-time: yes, but for the wait.
  std::chrono::nanoseconds wait_until(std::chrono::nanoseconds due) noexcept {
    const auto last = due + patience_;
    const auto rest = last - base_->now();
    if (rest.count() > 0 && hardware_->wait_for_cycle(rest) != Status::ok) {
      // Hardware that fails at once must not turn the loop into a busy one.
      static_cast<void>(base_->wait_until(last));
    }
    return base_->now();
  }

 private:
  HardwareType* hardware_;
  Base* base_;
  std::chrono::nanoseconds patience_;
};

}  // namespace articula
