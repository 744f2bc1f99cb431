// SPDX-License-Identifier: Apache-2.0
/// @file Times and durations of ROS messages as durations of C++.
#pragma once

#include "articula/ros2/messages/builtin_interfaces.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>

namespace articula::ros2 {

/// A time or duration as a message has it. Beyond 68 years it is the last one that a message can
/// have.
/// @tparam T  builtin_interfaces::msg::Time or Duration
/// Real-time: yes, likewise all functions of this header.
template <class T>
constexpr T to_message(std::chrono::nanoseconds time) noexcept {
  constexpr std::int64_t second = 1'000'000'000;
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  std::int64_t seconds = time.count() / second, rest = time.count() % second;
  if (rest < 0) {
    rest += second;
    --seconds;
  }
  return {static_cast<std::int32_t>(std::clamp(seconds, -most, most)),
          static_cast<std::uint32_t>(rest)};
}

/// A time of a message.
/// @tparam T  builtin_interfaces::msg::Time or Duration
template <class T>
constexpr std::chrono::nanoseconds from_message(const T& time) noexcept {
  return std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nanosec);
}

/// A duration of a message [s].
template <class T>
constexpr double seconds_of(const T& duration) noexcept {
  return static_cast<double>(duration.sec) + 1e-9 * static_cast<double>(duration.nanosec);
}

/// A number of seconds as a duration, within +-10^9 s; 0 for NaN.
inline std::chrono::nanoseconds to_duration(double seconds) noexcept {
  if (std::isnan(seconds)) return {};
  return std::chrono::nanoseconds(std::llround(std::clamp(seconds, -1e9, 1e9) * 1e9));
}

}  // namespace articula::ros2
