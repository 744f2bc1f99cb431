// SPDX-License-Identifier: Apache-2.0
/// @file A bound of what may happen in a time.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace articula::ros2::dds {

/// So many things may happen at once, and then so many in a second. Real-time: yes.
class Budget {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// @param most  at once
  /// @param rate  in a second
  constexpr Budget(double most, double rate) noexcept : most_(most), rate_(rate), left_(most) {}

  /// Takes as many as wanted, or as there are.
  /// @param now  not before the last one
  std::uint64_t take(std::uint64_t wanted, Time now) noexcept {
    left_ = std::min(most_, left_ + rate_ * std::chrono::duration<double>(now - last_).count());
    last_ = now;
    const std::uint64_t taken = std::min(wanted, static_cast<std::uint64_t>(left_));
    left_ -= static_cast<double>(taken);
    return taken;
  }

 private:
  double most_, rate_, left_;
  Time last_{};
};

}  // namespace articula::ros2::dds
