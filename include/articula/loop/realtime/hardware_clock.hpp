// SPDX-License-Identifier: Apache-2.0
/// @file Hardware that paces the loop.
#pragma once

#include "articula/core/hardware.hpp"
#include "articula/loop/loop_clock.hpp"

#include <chrono>
#include <cstdint>

namespace articula {

/// A clock that lets hardware pace the loop: cycles begin when the bus's own cycle does. Where that
/// stays away for half a period, the loop's cycle begins without it, late by that much, so that the
/// loop can notice and be safe; one period later it is waited for again. Any beginning within half
/// a period of when it was due is taken, so the loop finds the bus's pace again wherever that
/// resumes; but none sooner than half a period after the last, however often they come.
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
        patience_(
            std::chrono::nanoseconds(static_cast<std::chrono::nanoseconds::rep>(period * 1e9 / 2))),
        last_start_(base.now() - patience_) {}

  /// Real-time: yes, if the base clock's is.
  [[nodiscard]] std::chrono::nanoseconds now() noexcept { return base_->now(); }

  /// Waits for the hardware's next cycle.
  /// @param due  when it is expected
  /// @return     when it began; if it did not, when it was due, although it is later then
  /// Real-time: yes, but for the wait.
  std::chrono::nanoseconds wait_until(std::chrono::nanoseconds due) noexcept {
    for (auto now = base_->now(); now < due + patience_; now = base_->now()) {
      if (hardware_->wait_for_cycle(due + patience_ - now) != Status::ok) break;
      const auto begun = base_->now();
      const bool used_up = begun < due - patience_;  // it began during a cycle that took too long
      const bool too_soon = begun < last_start_ + patience_;
      if (!used_up && !too_soon) return last_start_ = begun;
      ++skipped_;
      if (!used_up) due = begun + 2 * patience_;  // that is the hardware's pace from here on
    }
    // Hardware that fails at once must not turn the loop into a busy one.
    static_cast<void>(base_->wait_until(due + patience_));
    ++timeouts_;
    last_start_ = base_->now();
    return due;
  }

  /// Cycles of the loop that began without the hardware's. Real-time: yes.
  [[nodiscard]] std::uint64_t timeouts() const noexcept { return timeouts_; }
  /// Cycles of the hardware that began too soon for the loop. Real-time: yes.
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
