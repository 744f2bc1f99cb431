// SPDX-License-Identifier: Apache-2.0
/// @file Simulated time, which advances when a loop waits.
#pragma once

#include <algorithm>
#include <chrono>

namespace articula {

/// A clock whose time passes only when somebody waits for it or says so: runs are deterministic and
/// as fast as the processor allows.
class SimulatedClock {
 public:
  /// Real-time: yes.
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept { return now_; }

  /// Jumps to `due`, unless that has passed. Real-time: yes.
  std::chrono::nanoseconds wait_until(std::chrono::nanoseconds due) noexcept {
    now_ = std::max(now_, due);
    return due;
  }

  /// Lets time pass, as a computation or a stalled machine would. Real-time: yes.
  void advance(std::chrono::nanoseconds duration) noexcept { now_ += duration; }

 private:
  std::chrono::nanoseconds now_{0};
};

}  // namespace articula
