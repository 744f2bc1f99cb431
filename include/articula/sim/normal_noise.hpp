// SPDX-License-Identifier: Apache-2.0
/// @file Noise for simulated sensors.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace articula {

/// Independent standard normal numbers, the same on every machine up to rounding of its
/// mathematical library. (The sequence of std::normal_distribution depends on the implementation,
/// and neither it nor the generators are noexcept.)
///
/// Sources: SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014);
/// Box and Muller: A note on the generation of random normal deviates, 1958.
class NormalNoise {
 public:
  /// @param seed  the same seed gives the same numbers
  explicit NormalNoise(std::uint64_t seed = 1) noexcept : state_(seed) {}

  /// The next number: mean 0, standard deviation 1. Real-time: yes.
  [[nodiscard]] double next() noexcept {
    if (has_second_) {
      has_second_ = false;
      return second_;
    }
    const double radius = std::sqrt(-2 * std::log(uniform()));
    const double angle = 2 * std::numbers::pi * uniform();
    second_ = radius * std::sin(angle);
    has_second_ = true;
    return radius * std::cos(angle);
  }

 private:
  /// In (0, 1], without 0, whose logarithm is infinite.
  [[nodiscard]] double uniform() noexcept {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t bits = state_;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
    bits ^= bits >> 31;
    return static_cast<double>((bits >> 11) + 1) * 0x1p-53;
  }

  std::uint64_t state_;
  double second_ = 0;  ///< second number of the last pair
  bool has_second_ = false;
};

}  // namespace articula
