// SPDX-License-Identifier: Apache-2.0
// Gripper arms that differ, in lanes and one by one: effort limits, stops, friction, sensors,
// delay.
#include "lane_arms.hpp"

#include <articula/robots/gripper_arm.hpp>

using namespace articula;

TEST_CASE("Gripper arms that differ move in lanes as one by one") {
  CHECK(support::compare<GripperArm>(1, {.whole = true, .noise = 1e-5, .delay = 2}, 1000).at_limit >
        100);
}

TEST_CASE("Gripper arms in lanes meet stops and dry friction as one by one") {
  const auto seen =
      support::compare<GripperArm>(2, {.whole = true, .friction = 0.1, .stop = 0.5}, 1000);
  CHECK(seen.at_stop > 100);
  CHECK(seen.at_rest > 100);
}
