// SPDX-License-Identifier: Apache-2.0
// Ur10s that differ, in lanes and one by one: effort limits, stops, friction, sensors, delay.
#include "lane_arms.hpp"

#include <articula/robots/ur10.hpp>

using namespace articula;

TEST_CASE("Ur10s that differ move in lanes as one by one") {
  CHECK(support::compare<Ur10>(1, {.noise = 1e-5, .delay = 2}, 1000).at_limit > 100);
}

TEST_CASE("Ur10s in lanes meet stops and dry friction as one by one") {
  const auto seen = support::compare<Ur10>(2, {.friction = 0.1, .stop = 0.5}, 1000);
  CHECK(seen.at_stop > 100);
  CHECK(seen.at_rest > 100);
}
