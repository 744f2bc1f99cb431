// SPDX-License-Identifier: Apache-2.0
/// @file Noise for simulated sensors.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/scalar.hpp"
#include "articula/sim/philox.hpp"
#include "articula/symbolic/sine_cosine.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace articula {

/// Two independent standard normal numbers.
/// @tparam S  type of a number: double, or a pack with a number of each robot
template <class S = double>
struct NormalPair {
  S first;
  S second;
};

/// Standard normal numbers that depend on their place alone: the noise of a joint in a cycle is the
/// same in any lane, thread or process, and whatever else is drawn. They are the same on every
/// machine up to rounding of its mathematical library. Real-time: yes.
///
/// Sources: Philox, see detail::philox; Box and Muller: A note on the generation of random normal
/// deviates, 1958.
/// @param seeds    the same seed gives the same numbers, to the last bit in any lane
/// @param cycle    number of the measurement
/// @param joint    index of the joint
/// @param channel  tells pairs of a joint apart, from 1 (0 is left to other draws of the seed)
template <class S = double>
[[nodiscard]] NormalPair<S> normal_noise(const JointArray<std::uint64_t, lanes<S>>& seeds,
                                         std::uint64_t cycle, int joint,
                                         std::uint32_t channel) noexcept {
  using std::sqrt;
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  // In (0, 1], without 0, whose logarithm is infinite.
  const auto share = [](std::uint32_t a, std::uint32_t b) {
    return static_cast<double>(((a | std::uint64_t{b} << 32) >> 11) + 1) * 0x1p-53;
  };
  S square(0);
  std::array<S, 1> angle{S(0)}, sine, cosine;
  for (int k = 0; k < lanes<S>; ++k) {
    const detail::PhiloxCounter bits =
        detail::philox({low(cycle), high(cycle), static_cast<std::uint32_t>(joint), channel},
                       {low(seeds[k]), high(seeds[k])});
    set_lane(square, k, -2 * std::log(share(bits[0], bits[1])));
    set_lane(angle[0], k, 2 * std::numbers::pi * share(bits[2], bits[3]));
  }
  symbolic::sine_cosine(angle, sine, cosine);
  const S radius = sqrt(square);
  return {radius * cosine[0], radius * sine[0]};
}

/// The same of one seed. Real-time: yes.
[[nodiscard]] inline NormalPair<> normal_noise(std::uint64_t seed, std::uint64_t cycle, int joint,
                                               std::uint32_t channel) noexcept {
  return normal_noise<double>({seed}, cycle, joint, channel);
}

}  // namespace articula
