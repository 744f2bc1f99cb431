// SPDX-License-Identifier: Apache-2.0
/// @file A bound of the numbers that Fast DDS has to go through.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace articula::ros2::dds {

/// The numbers of messages that may be skipped, of all writers together. Fast DDS 2.9.1 takes some
/// 1.2 us for each of them, so it is busy with them for a third of a second each second at most.
/// Real-time: yes.
class StepBudget {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr double most = 1 << 18;  ///< at once, and in a second

  /// Takes as many as wanted, or as there are.
  /// @param now  not before the last one
  std::uint64_t take(std::uint64_t wanted, Time now) noexcept {
    left_ = std::min(most, left_ + most * std::chrono::duration<double>(now - last_).count());
    last_ = now;
    const std::uint64_t taken = std::min(wanted, static_cast<std::uint64_t>(left_));
    left_ -= static_cast<double>(taken);
    return taken;
  }

 private:
  double left_ = most;
  Time last_{};
};

}  // namespace articula::ros2::dds
