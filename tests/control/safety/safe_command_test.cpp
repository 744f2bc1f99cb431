// SPDX-License-Identifier: Apache-2.0
#include <articula/control/safety/safe_command.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "robots/blueprint.hpp"

using namespace articula;

TEST_CASE("where gravity's effort at a finite position overflows, the safe effort is zero") {
  // A mass of 2 kg slides along a beam that turns: far out, the beam feels more than a number
  // holds.
  const auto robot = support::Blueprint{
      .name = "beam",
      .links = {{.name = "stand"},
                {.name = "beam", .mass = 1, .inertia = {.xx = 1, .yy = 1, .zz = 1}},
                {.name = "slide", .mass = 2, .inertia = {.xx = 1, .yy = 1, .zz = 1}}},
      .joints = {
          {.name = "turn",
           .type = JointType::continuous,
           .parent = "stand",
           .child = "beam",
           .axis = {0, 1, 0}},
          {.name = "rail",
           .type = JointType::prismatic,
           .parent = "beam",
           .child = "slide",
           .axis = {1, 0,
                    0}}}}.model<2>();
  const EffortCommand<2> last{{1, 1}};
  CHECK(safe_command(robot, {0, 3}, last).effort.isApprox(gravity(robot, {0, 3})));
  CHECK(safe_command(robot, {0, support::largest}, last).effort == JointVector<2>(0, 0));
  CHECK(safe_command(robot, {support::not_a_number, 3}, last).effort == JointVector<2>(0, 0));
}
