// SPDX-License-Identifier: Apache-2.0
#include <articula/sim/normal_noise.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "catch.hpp"

using namespace articula;

namespace {

/// The mean of the products of two samples, whose deviation is 1/sqrt(n) if they are independent.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum / static_cast<double>(a.size());
}

}  // namespace

// Philox4x32-10 of counter and key 0 is 6627e8d5 e169c58d bc57ac4c 9b00dbd8 (Random123's
// kat_vectors); here counter and key are those of channel 0.
TEST_CASE("the numbers are those of Philox and of Box and Muller") {
  const auto share = [](std::uint64_t bits) {
    return static_cast<double>((bits >> 11) + 1) / 9007199254740992.0;
  };
  const double u = share(0xe169c58d6627e8d5U), v = share(0x9b00dbd8bc57ac4cU);
  const double radius = std::sqrt(-2 * std::log(u)), angle = 2 * std::numbers::pi * v;
  const auto [first, second] = normal_noise(0, 0, 0, 0);
  CHECK(std::abs(first - radius * std::cos(angle)) < 1e-15);  // rounding of another libm
  CHECK(std::abs(second - radius * std::sin(angle)) < 1e-15);
}

TEST_CASE("the numbers are distributed as they should be, for any seed") {
  constexpr std::size_t count = 100'000;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
    CAPTURE(seed);
    std::vector<double> first(count), second(count), joint(count), channel(count), later(count);
    for (std::size_t k = 0; k < count; ++k) {
      const NormalPair pair = normal_noise(seed, k, 0, 1);
      first[k] = pair.first;
      second[k] = pair.second;
      later[k] = normal_noise(seed, k + 1, 0, 1).first;
      joint[k] = normal_noise(seed, k, 1, 1).first;
      channel[k] = normal_noise(seed, k, 0, 2).first;
    }
    const double independent = 5 / std::sqrt(count);
    CHECK(std::abs(correlation(first, second)) < independent);
    CHECK(std::abs(correlation(first, later)) < independent);
    CHECK(std::abs(correlation(first, joint)) < independent);
    CHECK(std::abs(correlation(first, channel)) < independent);
    // Kolmogorov and Smirnov: farther from the normal distribution than this is one sample in 10^6
    // (2 exp(-2 n d^2), Massart's bound), and the seeds are fixed.
    const double bound = std::sqrt(std::log(2 / 1e-6) / (2 * count));
    for (std::vector<double>* values : {&first, &second}) {
      std::sort(values->begin(), values->end());
      double distance = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const double normal = std::erfc(-(*values)[k] / std::sqrt(2.0)) / 2;
        distance = std::max({distance, std::abs(normal - static_cast<double>(k) / count),
                             std::abs(normal - static_cast<double>(k + 1) / count)});
      }
      CHECK(distance < bound);
    }
  }
}
