// SPDX-License-Identifier: Apache-2.0
#include <articula/robots/pr2.hpp>

#include <articula/dynamics/dynamics.hpp>

#include "catch.hpp"
#include "robots/blueprint.hpp"

#include <string>

using namespace articula;

namespace {

const Model<20, 30>& pr2() {
  static const auto model = support::blueprint_of(Pr2::description).model<20, 30>();
  return model;
}

const JointLimits& limits_of(std::string_view joint) {
  return pr2().joints[static_cast<std::size_t>(joint_index(pr2(), joint))].limits;
}

}  // namespace

TEST_CASE("The PR2's joints, depth first and by name") {
  CHECK(joint_names(Pr2{}) ==
        std::array<std::string_view, 20>{
            "torso_lift_joint",     "head_pan_joint",           "head_tilt_joint",
            "l_shoulder_pan_joint", "l_shoulder_lift_joint",    "l_upper_arm_roll_joint",
            "l_elbow_flex_joint",   "l_forearm_roll_joint",     "l_wrist_flex_joint",
            "l_wrist_roll_joint",   "l_gripper_l_finger_joint", "laser_tilt_mount_joint",
            "r_shoulder_pan_joint", "r_shoulder_lift_joint",    "r_upper_arm_roll_joint",
            "r_elbow_flex_joint",   "r_forearm_roll_joint",     "r_wrist_flex_joint",
            "r_wrist_roll_joint",   "r_gripper_l_finger_joint"});
  CHECK(model_of(Pr2{}).body_count == 30);
}

TEST_CASE("The PR2's grippers have room to move") {
  for (const char* gripper : {"l_gripper_l_finger_joint", "r_gripper_l_finger_joint"}) {
    CHECK(limits_of(gripper).lower == 0);
    CHECK(limits_of(gripper).upper == 0.548);
    CHECK(limits_of(gripper).velocity == 0.5);
  }
}

TEST_CASE("The PR2's grippers close around their middle") {
  JointVector<20> q = JointVector<20>::Zero();
  for (const std::string side : {"l_", "r_"})
    q[joint_index(pr2(), side + "gripper_l_finger_joint")] = 0.4;
  for (const std::string side : {"l_", "r_"}) {
    const auto in_palm = [&](const std::string& link) {
      return Eigen::Isometry3d(forward_kinematics(pr2(), q, side + "gripper_palm_link").inverse() *
                               forward_kinematics(pr2(), q, side + link));
    };
    for (const std::string part : {"finger_tip_link", "parallel_link"}) {
      const Eigen::Isometry3d left = in_palm("gripper_l_" + part),
                              right = in_palm("gripper_r_" + part);
      CHECK((right.translation() - Eigen::Vector3d(1, -1, 1).cwiseProduct(left.translation()))
                .norm() < 1e-14);
      // Turned by opposite angles about z.
      CHECK((right.linear() - left.linear().transpose()).norm() < 1e-14);
    }
  }
}

TEST_CASE("The PR2's limits are mirrored between its arms") {
  CHECK(limits_of("l_shoulder_pan_joint").lower == -limits_of("r_shoulder_pan_joint").upper);
  CHECK(limits_of("l_shoulder_pan_joint").upper == -limits_of("r_shoulder_pan_joint").lower);
  CHECK(limits_of("l_upper_arm_roll_joint").lower == -limits_of("r_upper_arm_roll_joint").upper);
  CHECK(limits_of("l_upper_arm_roll_joint").upper == -limits_of("r_upper_arm_roll_joint").lower);
  CHECK(limits_of("r_forearm_roll_joint").upper == JointLimits::infinity);
}

TEST_CASE("The PR2's torso lifts all that it carries") {
  const double weight = gravity(pr2(), JointVector<20>::Zero())[0];
  double mass = 0;
  for (const Body& body : pr2().mechanism.bodies) mass += body.inertia.mass;
  CHECK(weight == Approx(9.81 * mass).epsilon(1e-13));
  CHECK(mass > 100);
}

TEST_CASE("Efforts on a gripper of the PR2 do not reach the other arm's factors") {
  // Joints that follow one another stay within their arm, and so do the ways to the base.
  const auto before = elimination_tree(pr2().mechanism);
  const auto index = [](std::string_view name) { return joint_index(pr2(), name); };
  const auto at = [&](std::string_view name) {
    return before[static_cast<std::size_t>(index(name))];
  };
  CHECK(at("torso_lift_joint") == -1);
  CHECK(at("l_gripper_l_finger_joint") == index("l_wrist_roll_joint"));
  CHECK(at("r_shoulder_pan_joint") == index("torso_lift_joint"));
  CHECK(at("laser_tilt_mount_joint") == index("torso_lift_joint"));
}
