// SPDX-License-Identifier: Apache-2.0
/// @file The functions that hardware around other hardware passes on.
#pragma once

#include "articula/core/hardware.hpp"

#include <chrono>
#include <utility>

namespace articula::detail {

/// Hardware around other hardware: passes on all but `robot`, `read` and `write`.
/// @tparam H  the hardware inside
template <class H>
class HardwareAdapter {
 public:
  explicit HardwareAdapter(H hardware) : hardware_(std::move(hardware)) {}

  [[nodiscard]] Status activate() { return hardware_.activate(); }
  [[nodiscard]] Status deactivate() { return hardware_.deactivate(); }
  /// The period of the hardware inside [s], if it has one. Real-time: yes.
  [[nodiscard]] double period() const noexcept
    requires requires(const H& hardware) { hardware.period(); }
  {
    return hardware_.period();
  }
  /// Waits for the cycle of the hardware inside, if it has one. Real-time: yes, but for the wait.
  [[nodiscard]] Status wait_for_cycle(std::chrono::nanoseconds timeout) noexcept
    requires PacingHardware<H>
  {
    return hardware_.wait_for_cycle(timeout);
  }
  /// The hardware inside. Real-time: yes.
  [[nodiscard]] H& hardware() noexcept { return hardware_; }
  [[nodiscard]] const H& hardware() const noexcept { return hardware_; }

 protected:
  H hardware_;
};

}  // namespace articula::detail
