// SPDX-License-Identifier: Apache-2.0
/// @file Noise for simulated sensors.
#pragma once

#include "articula/sim/philox.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace articula {

/// Two independent standard normal numbers.
struct NormalPair {
  double first;
  double second;
};

/// Standard normal numbers that depend on their place alone: the noise of a joint in a cycle is the
/// same in any lane, thread or process, and whatever else is drawn. They are the same on every machine
/// up to rounding of its mathematical library. Real-time: yes.
///
/// Sources: Philox, see detail::philox; Box and Muller: A note on the generation of random normal
/// deviates, 1958.
/// @param seed     the same seed gives the same numbers
/// @param cycle    number of the measurement
/// @param joint    index of the joint
/// @param channel  tells pairs of a joint apart, from 1 (0 is left to other draws of the seed)
[[nodiscard]] inline NormalPair normal_noise(std::uint64_t seed, std::uint64_t cycle, int joint,
                                             std::uint32_t channel) noexcept {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const detail::PhiloxCounter bits =
      detail::philox({low(cycle), high(cycle), static_cast<std::uint32_t>(joint), channel},
                     {low(seed), high(seed)});
  // In (0, 1], without 0, whose logarithm is infinite.
  const auto share = [](std::uint32_t a, std::uint32_t b) {
    return static_cast<double>(((a | std::uint64_t{b} << 32) >> 11) + 1) * 0x1p-53;
  };
  const double radius = std::sqrt(-2 * std::log(share(bits[0], bits[1])));
  const double angle = 2 * std::numbers::pi * share(bits[2], bits[3]);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace articula
