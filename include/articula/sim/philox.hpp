// SPDX-License-Identifier: Apache-2.0
/// @file The counter-based random numbers Philox4x32-10.
#pragma once

#include <array>
#include <cstdint>

namespace articula::detail {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

/// 128 random bits of a counter and a key: the same two give the same bits, in any order of calls.
/// Source: Philox4x32 with ten rounds (Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy
/// as 1, 2, 3, SC11, 2011). Real-time: yes.
[[nodiscard]] constexpr PhiloxCounter philox(PhiloxCounter x, PhiloxKey key) noexcept {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t first = std::uint64_t{0xd2511f53} * x[0];
    const std::uint64_t second = std::uint64_t{0xcd9e8d57} * x[2];
    x = {static_cast<std::uint32_t>(second >> 32) ^ x[1] ^ key[0],
         static_cast<std::uint32_t>(second),
         static_cast<std::uint32_t>(first >> 32) ^ x[3] ^ key[1],
         static_cast<std::uint32_t>(first)};
    key[0] += 0x9e3779b9;
    key[1] += 0xbb67ae85;
  }
  return x;
}

}  // namespace articula::detail
