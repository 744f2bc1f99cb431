// SPDX-License-Identifier: Apache-2.0
#include <articula/robots/gripper_arm.hpp>

#include <articula/dynamics/dynamics.hpp>

#include "catch.hpp"
#include "robots/blueprint.hpp"

using namespace articula;
using Eigen::Vector3d;

namespace {

const Model<7, 12>& arm() {
  static const auto model = support::blueprint_of(GripperArm::description).model<7, 12>();
  return model;
}

/// The arm in any pose, the gripper closed by an angle [rad].
JointVector<7> closed_by(double angle) { return {0.3, -0.5, 1.1, 0.7, -0.4, 0.9, angle}; }

}  // namespace

TEST_CASE("The gripper arm has six joints, and one for its gripper") {
  CHECK(joint_names(GripperArm{}) ==
        std::array<std::string_view, 7>{"joint_1", "joint_2", "joint_3", "joint_4", "joint_5",
                                        "joint_6", "left_outer_knuckle_joint"});
  const JointLimits& gripper = model_of(GripperArm{}).joints[6].limits;
  CHECK(gripper.lower == 0);  // those of all that follow leave it its full range
  CHECK(gripper.upper == 0.8);
}

TEST_CASE("The gripper arm's shoulder is the link that descriptions of such arms give") {
  const Link& link = GripperArm::description.links[1];
  CHECK(link.mass == 0.85);
  CHECK(link.center_of_mass == Vector3<double>{0, 0, 0.05});
  CHECK(link.inertia == Symmetric3<double>{0.001458, 0, 0, 0.001458, 0, 0.002025});
}

TEST_CASE("The gripper's tips keep their direction and meet in the middle") {
  const auto in_palm = [](double angle, std::string_view link) {
    const JointVector<7> q = closed_by(angle);
    return Eigen::Isometry3d(forward_kinematics(arm(), q, "gripper_base_link").inverse() *
                             forward_kinematics(arm(), q, link));
  };
  for (const double angle : {0.0, 0.25, 0.8}) {
    const Eigen::Isometry3d left = in_palm(angle, "left_fingertip"),
                            right = in_palm(angle, "right_fingertip");
    CHECK((left.linear() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK((right.linear() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK((right.translation() - Vector3d(-1, 1, 1).cwiseProduct(left.translation())).norm() <
          1e-15);
  }
  const double open = in_palm(0, "left_fingertip").translation().x();
  const double closed = in_palm(0.8, "left_fingertip").translation().x();
  CHECK(open == Approx(0.0621));
  CHECK(closed < 0.03);
  CHECK(closed > 0);
}

TEST_CASE("What closes the gripper does not turn the arm about its last axis") {
  // The fingers are mirror images, so their reactions on the flange cancel.
  const JointMatrix<7> mass = mass_matrix(arm(), closed_by(0.3));
  CHECK(std::abs(mass(5, 6)) < 1e-16);
  CHECK(mass(6, 6) > 0);
}
