// SPDX-License-Identifier: Apache-2.0
/// @file The system's monotonic clock. Linux and other POSIX systems.
#pragma once

#include <cerrno>
#include <chrono>
#include <ctime>

namespace articula {

/// CLOCK_MONOTONIC with waits until absolute times, so that delays between two waits do not shift
/// later cycles. Source: POSIX.1-2017, clock_nanosleep.
class MonotonicClock {
 public:
  /// The time since an arbitrary moment. Real-time: yes, but for reading the clock.
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  }

  /// Sleeps until `due`, also if signals arrive. Real-time: yes, but for the sleep.
  std::chrono::nanoseconds wait_until(std::chrono::nanoseconds due) const noexcept {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(due);
    const timespec time{seconds.count(), (due - seconds).count()};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
    }
    return due;
  }
};

}  // namespace articula
