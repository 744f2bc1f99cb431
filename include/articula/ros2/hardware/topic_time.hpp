// SPDX-License-Identifier: Apache-2.0
/// @file A moment by the clock of this host and by that of a simulator.
#pragma once

#include <algorithm>
#include <chrono>

namespace articula::ros2 {

/// When something came. Without a simulator's clock both times are this host's.
struct TopicTime {
  std::chrono::nanoseconds host{}, simulated{};
  friend constexpr auto operator<=>(const TopicTime&, const TopicTime&) = default;
};

/// How old something is, by the clock in which it is younger. So nothing grows old while a
/// simulator is paused or slow, nor in the moment at which its clock has made a long step.
/// Real-time: yes.
[[nodiscard]] constexpr std::chrono::nanoseconds age(const TopicTime& now,
                                                     const TopicTime& then) noexcept {
  return std::min(now.host - then.host, now.simulated - then.simulated);
}

}  // namespace articula::ros2
