// SPDX-License-Identifier: Apache-2.0
// Torsos that differ, in lanes and one by one: effort limits, stops, friction, sensors, delay.
#include "lane_arms.hpp"

#include <articula/robots/two_arm_torso.hpp>

using namespace articula;

TEST_CASE("Torsos that differ move in lanes as one by one") {
  CHECK(support::compare<TwoArmTorso>(1, {.noise = 1e-5, .delay = 2}, 1000).at_limit > 100);
}

TEST_CASE("Torsos in lanes meet stops and dry friction as one by one") {
  const auto seen = support::compare<TwoArmTorso>(2, {.friction = 0.1, .stop = 0.3}, 1000);
  CHECK(seen.at_stop > 100);
  CHECK(seen.at_rest > 100);
}
