// SPDX-License-Identifier: Apache-2.0
#include <articula/sim/normal_noise.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "catch.hpp"

using namespace articula;

// Computed with Python from the published generator, whose output for this seed begins with
// 6457827717110365317, 3203168211198807973.
TEST_CASE("the numbers are those of SplitMix64 and Box and Muller") {
  NormalNoise noise(1234567);
  for (const double expected :
       {0.6687418474759109, 1.2852914518644605, 0.007002816605279968, 1.1231185837046664}) {
    CHECK(std::abs(noise.next() - expected) < 1e-15);  // rounding of another libm
  }
}

TEST_CASE("the numbers are distributed as they should be, for any seed") {
  constexpr int count = 100'000;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}}) {
    CAPTURE(seed);
    NormalNoise noise(seed);
    std::vector<double> values(count);
    for (double& value : values) value = noise.next();
    // Kolmogorov and Smirnov: farther from the normal distribution than this is one sample in 10^6
    // (2 exp(-2 n d^2), Massart's bound), and the seeds are fixed.
    std::sort(values.begin(), values.end());
    const double bound = std::sqrt(std::log(2 / 1e-6) / (2 * count));
    double distance = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double normal = std::erfc(-values[k] / std::sqrt(2.0)) / 2;
      distance = std::max({distance, std::abs(normal - static_cast<double>(k) / count),
                           std::abs(normal - static_cast<double>(k + 1) / count)});
    }
    CHECK(distance < bound);
    // Neighbours have nothing to do with each other: the deviation of this mean is 1/sqrt(n).
    NormalNoise again(seed);
    double before = again.next(), product = 0;
    for (int k = 1; k < count; ++k) {
      const double value = again.next();
      product += before * value / count;
      before = value;
    }
    CHECK(std::abs(product) < 5 / std::sqrt(count));
  }
}
