// SPDX-License-Identifier: Apache-2.0
/// @file A loop clock that follows the cycle of a bus.
#pragma once

#include "articula/core/hardware.hpp"
#include "articula/loop/loop_clock.hpp"

#include <chrono>
#include <cstdint>

namespace articula {

/// A clock by which the hardware paces the loop: a cycle of the loop begins with a cycle of the
/// bus.
///
/// - A cycle of the bus counts if it begins within half a period of its due time. It must begin at
///   least half a period after the last one, too.
/// - If none begins by then, the loop's cycle begins without it, half a period late, so that the
///   loop can detect the loss. The next one is due a period later.
///
/// So the loop finds the pace of the bus again after any interruption.
/// @tparam HardwareType  satisfies PacingHardware
/// @tparam Base          a clock for the time and for waits when the hardware fails
template <PacingHardware HardwareType, LoopClock Base>
class HardwareClock {
 public:
  /// @param hardware  outlives the clock
  /// @param base      outlives the clock
  /// @param period    of the loop [s]
  HardwareClock(HardwareType& hardware, Base& base, double period)
      : hardware_(&hardware),
        base_(&base),
        patience_(
            std::chrono::nanoseconds(static_cast<std::chrono::nanoseconds::rep>(period * 1e9 / 2))),
        last_start_(base.now() - patience_) {}

  /// Real-time: yes, if the base clock's is.
  [[nodiscard]] std::chrono::nanoseconds now() noexcept { return base_->now(); }

  /// Waits for the next cycle of the hardware.
  /// @param due  when it is expected
  /// @return     when it began; `due` if it did not begin
  /// Real-time: yes, but for the wait.
  std::chrono::nanoseconds wait_until(std::chrono::nanoseconds due) noexcept {
    for (auto now = base_->now(); now < due + patience_; now = base_->now()) {
      if (hardware_->wait_for_cycle(due + patience_ - now) != Status::ok) break;
      const auto begun = base_->now();
      const bool missed = begun < due - patience_;  // it began during a cycle that took too long
      const bool too_soon = begun < last_start_ + patience_;
      if (!missed && !too_soon) return last_start_ = begun;
      ++skipped_;
      if (!missed) due = begun + 2 * patience_;  // follows the new pace of the hardware
    }
    // If the hardware's wait fails at once, the loop must not run without pauses.
    static_cast<void>(base_->wait_until(due + patience_));
    ++timeouts_;
    last_start_ = base_->now();
    return due;
  }

  /// Number of loop cycles without a hardware cycle. Real-time: yes.
  [[nodiscard]] std::uint64_t timeouts() const noexcept { return timeouts_; }
  /// Number of hardware cycles that began too soon. Real-time: yes.
  [[nodiscard]] std::uint64_t skipped() const noexcept { return skipped_; }

 private:
  HardwareType* hardware_;
  Base* base_;
  std::chrono::nanoseconds patience_;  ///< half a period
  std::chrono::nanoseconds last_start_;
  std::uint64_t timeouts_ = 0;
  std::uint64_t skipped_ = 0;
};

}  // namespace articula
