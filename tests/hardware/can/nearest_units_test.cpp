// SPDX-License-Identifier: Apache-2.0
#include <articula/hardware/can/nearest_units.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "catch.hpp"

using articula::nearest_units;

TEST_CASE("nearest_units: rounds as std::llround does, next to halves, too") {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int32_t> halves(-2147483646, 2147483646);
  for (int i = 0; i < 100000; ++i) {
    const std::int32_t large = halves(random);
    for (const std::int32_t number : {large, large % 32768, large % 4}) {
      const double half = number / 2.0;
      for (const double value : {half, std::nextafter(half, 1e300), std::nextafter(half, -1e300)}) {
        REQUIRE(nearest_units(value, 2147483647) == std::llround(value));
      }
    }
  }
}

TEST_CASE("nearest_units: stays within the range") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double most : {32767.0, 2147483647.0}) {
    const auto largest = static_cast<std::int32_t>(most);
    for (const double beyond : {most, most + 0.4, most + 0.6, 1e300, infinity}) {
      CHECK(nearest_units(beyond, most) == largest);
      CHECK(nearest_units(-beyond, most) == -largest);
    }
    CHECK(nearest_units(most - 0.6, most) == largest - 1);
  }
  CHECK(nearest_units(-0.0, 1) == 0);
}
