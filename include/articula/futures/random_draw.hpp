// SPDX-License-Identifier: Apache-2.0
/// @file Random numbers that depend on their place alone.
#pragma once

#include <cstdint>

namespace articula::detail {

/// 64 random bits of a key and a number. The same two give the same bits, in any order of calls.
/// Source: the output function of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number
/// generators, 2014). Real-time: yes.
[[nodiscard]] constexpr std::uint64_t random_bits(std::uint64_t key,
                                                  std::uint64_t number) noexcept {
  std::uint64_t bits = key + (number + 1) * 0x9e3779b97f4a7c15;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}

/// A number within 1 - spread .. 1 + spread, all equally probable. Real-time: yes.
[[nodiscard]] constexpr double random_factor(std::uint64_t key, std::uint64_t number,
                                             double spread) noexcept {
  const double share = static_cast<double>(random_bits(key, number) >> 11) * 0x1p-53;
  return 1 + spread * (2 * share - 1);
}

/// A number with mean 0 and standard deviation 1 from a bell-shaped distribution: the sum of four
/// equally distributed numbers, at most 3.5 in size. Cheaper than NormalNoise. Real-time: yes.
[[nodiscard]] constexpr double random_noise(std::uint64_t key, std::uint64_t number) noexcept {
  const std::uint64_t bits = random_bits(key, number);
  const std::uint64_t sum =
      (bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) + (bits >> 48);
  return (static_cast<double>(sum) * 0x1p-16 - 2 + 0x1p-15) * 1.7320508075688772;
}

}  // namespace articula::detail
