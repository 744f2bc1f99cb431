// SPDX-License-Identifier: Apache-2.0
/// @file A random order of numbers that needs no memory.
#pragma once

#include "articula/sim/random_draw.hpp"

#include <bit>
#include <cstdint>

namespace articula::detail {

/// A random permutation of 0 .. count - 1 of which each element is computed alone. It is a Feistel
/// network over the next even number of bits, repeated until the result is below count.
/// Source: Black, Rogaway: Ciphers with arbitrary finite domains, CT-RSA 2002.
class KeyedPermutation {
 public:
  /// @param count  at least 1, at most 2^62
  /// @param key    the same key gives the same permutation
  KeyedPermutation(std::uint64_t count, std::uint64_t key) noexcept : count_(count), key_(key) {
    const int bits = static_cast<int>(std::bit_width(count - 1));
    half_ = bits < 2 ? 1 : (bits + 1) / 2;
  }

  /// The element at a place.
  /// @param place  0 .. count - 1
  /// Real-time: yes. The network runs less than four times on average.
  [[nodiscard]] std::uint64_t operator()(std::uint64_t place) const noexcept {
    do {
      place = network(place);
    } while (place >= count_);
    return place;
  }

 private:
  [[nodiscard]] std::uint64_t network(std::uint64_t x) const noexcept {
    const std::uint64_t mask = (std::uint64_t{1} << half_) - 1;
    std::uint64_t left = x >> half_, right = x & mask;
    for (std::uint32_t round = 0; round < 6; ++round) {
      const std::uint64_t mixed = left ^ (random_bits(key_, right, round, 1) & mask);
      left = right;
      right = mixed;
    }
    return left << half_ | right;
  }

  std::uint64_t count_;
  std::uint64_t key_;
  int half_ = 1;
};

}  // namespace articula::detail
