// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a clock that paces a loop.
#pragma once

#include <chrono>
#include <concepts>

namespace articula {

/// What paces a running loop.
///
/// - `now()` is the time since some fixed moment. It never runs backwards.
/// - `wait_until(due)` waits for the cycle that is due at that time and returns when it was due
///   indeed. That is `due` itself for a clock of its own. For hardware that dictates the pace it is
///   the arrival of the bus's cycle. The next cycle is due one period after what it returned.
template <class C>
concept LoopClock = requires(C clock, std::chrono::nanoseconds due) {
  { clock.now() } noexcept -> std::same_as<std::chrono::nanoseconds>;
  { clock.wait_until(due) } noexcept -> std::same_as<std::chrono::nanoseconds>;
};

}  // namespace articula
