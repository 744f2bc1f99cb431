// SPDX-License-Identifier: Apache-2.0
#include "articula/dynamics/moving_joints.hpp"

#include "catch.hpp"
#include "robots/blueprint.hpp"

using namespace articula;

namespace {

constexpr Link ball(const char* name) {
  return {.name = name, .mass = 1, .inertia = {.xx = 0.01, .yy = 0.01, .zz = 0.01}};
}
constexpr Joint turning(const char* name, const char* parent, const char* child) {
  return {.name = name, .type = JointType::continuous, .parent = parent, .child = child};
}

/// A wrist that carries two fingers, of which the first by name mimics the second.
struct Gripper {
  static constexpr auto description = [] {
    RobotDescription<4, 3> gripper{
        .name = "gripper",
        .links = {ball("base"), ball("palm"), ball("left"), ball("right")},
        .joints = {turning("wrist", "base", "palm"), turning("a_left", "palm", "left"),
                   turning("b_right", "palm", "right")}};
    gripper.joints[1].mimic = {.joint = "b_right", .multiplier = -1.5, .offset = 0.25};
    return gripper;
  }();
};

}  // namespace

TEMPLATE_TEST_CASE("joints that mimic others are listed with their positions and velocities", "",
                   Gripper, (Model<2, 3>)) {
  const TestType robot = [] {
    if constexpr (DescribedRobot<TestType>) {
      return TestType();
    } else {
      return support::blueprint_of(Gripper::description).model<2, 3>();
    }
  }();
  REQUIRE(moving_joint_count<TestType> == 3);
  CHECK(moving_joint_names(robot) == std::array<std::string_view, 3>{"wrist", "a_left", "b_right"});
  CHECK(joint_names(robot) == std::array<std::string_view, 2>{"wrist", "b_right"});
  CHECK(moving_joint_positions(robot, {0.5, 2}) == JointVector<3>(0.5, -2.75, 2));
  CHECK(moving_joint_velocities(robot, {0.5, 2}) == JointVector<3>(0.5, -3, 2));
}

TEST_CASE("without mimics the joints that move are those that can be commanded") {
  support::Blueprint free = support::blueprint_of(Gripper::description);
  for (Joint& joint : free.joints) joint.mimic = {};
  const Model<3> model = free.model<3>();
  CHECK(moving_joint_names(model) == joint_names(model));
  CHECK(moving_joint_positions(model, {1, 2, 3}) == JointVector<3>(1, 2, 3));
}
