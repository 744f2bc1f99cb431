// SPDX-License-Identifier: Apache-2.0
/// @file Random numbers that depend on their place alone.
#pragma once

#include "articula/sim/philox.hpp"

#include <cstdint>

namespace articula::detail {

/// 64 random bits of a key and a place. The same ones give the same bits, in any order of calls.
/// @param key     seed
/// @param number  of the run, or of the draw
/// @param what    parameter or joint
/// @param cycle   of the loop
/// Real-time: yes.
[[nodiscard]] constexpr std::uint64_t random_bits(std::uint64_t key, std::uint64_t number,
                                                  std::uint32_t what = 0,
                                                  std::uint32_t cycle = 0) noexcept {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const PhiloxCounter bits =
      philox({low(number), high(number), what, cycle}, {low(key), high(key)});
  return bits[0] | static_cast<std::uint64_t>(bits[1]) << 32;
}

/// Random bits as a number within 0 .. 1, neither of which it reaches. Real-time: yes.
[[nodiscard]] constexpr double share_of_bits(std::uint64_t bits) noexcept {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

/// A number within 1 - spread .. 1 + spread, all equally probable. Real-time: yes.
[[nodiscard]] constexpr double random_factor(std::uint64_t key, std::uint64_t number,
                                             double spread) noexcept {
  return 1 + spread * (2 * share_of_bits(random_bits(key, number)) - 1);
}

}  // namespace articula::detail
