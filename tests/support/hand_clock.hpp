// SPDX-License-Identifier: Apache-2.0
/// @file A host's clock that a test moves.
#pragma once

#include <chrono>

namespace support {

/// A clock that stands still unless a test moves it.
struct HandClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<HandClock>;
  [[maybe_unused]] static constexpr bool is_steady = true;
  static time_point now() noexcept { return time_point(time); }
  static inline duration time{1'000'000'000};
};

}  // namespace support
