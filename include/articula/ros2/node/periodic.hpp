// SPDX-License-Identifier: Apache-2.0
/// @file The times at which something periodic is due.
#pragma once

#include <chrono>

namespace articula::ros2 {

/// Something that is done at a rate, on a clock that may jump.
class Periodic {
 public:
  /// @param rate  [Hz], > 0
  explicit Periodic(double rate)
      : period_(std::chrono::duration_cast<std::chrono::nanoseconds>(
            std::chrono::duration<double>(1 / rate))) {}

  /// Whether it is due, which it is the first time. Periods that have passed are not made up for.
  /// Real-time: yes.
  [[nodiscard]] bool due(std::chrono::nanoseconds now) noexcept {
    const auto passed = now - last_;
    if (begun_ && passed >= std::chrono::nanoseconds(0) && passed < period_) return false;
    last_ = begun_ && passed >= period_ && passed < 2 * period_ ? last_ + period_ : now;
    begun_ = true;
    return true;
  }

 private:
  std::chrono::nanoseconds period_;
  std::chrono::nanoseconds last_{0};
  bool begun_ = false;
};

}  // namespace articula::ros2
