// SPDX-License-Identifier: Apache-2.0
#include <articula/robots/two_arm_torso.hpp>

#include <articula/dynamics/dynamics.hpp>

#include "catch.hpp"

using namespace articula;
using Eigen::Vector3d;

TEST_CASE("The torso's joints and limits") {
  CHECK(joint_names(TwoArmTorso{}) ==
        std::array<std::string_view, 6>{"left_shoulder_pitch_joint", "left_shoulder_roll_joint",
                                        "left_elbow_joint", "right_shoulder_pitch_joint",
                                        "right_shoulder_roll_joint", "right_elbow_joint"});
  const auto lower = joint_values(TwoArmTorso{}, [](auto& joint) { return joint.limits.lower; });
  const auto upper = joint_values(TwoArmTorso{}, [](auto& joint) { return joint.limits.upper; });
  CHECK(lower == JointVector<6>(-3.14, -1.57, 0, -3.14, -1.57, 0));
  CHECK(upper == JointVector<6>(3.14, 1.57, 2.356, 3.14, 1.57, 2.356));
}

TEST_CASE("The torso's arms hang down at zero, and elbows bend forward") {
  const JointVector<6> zero = JointVector<6>::Zero();
  CHECK(gravity(TwoArmTorso{}, zero).cwiseAbs()[0] < 1e-15);
  CHECK(gravity(TwoArmTorso{}, zero).cwiseAbs()[2] < 1e-15);
  JointVector<6> bent = zero;
  bent[2] = bent[5] = 1.5;
  for (const char* side : {"left", "right"}) {
    const Vector3d hand =
        forward_kinematics(TwoArmTorso{}, bent, std::string(side) + "_forearm_link") *
        Vector3d(0, 0, -0.25);
    const Vector3d elbow =
        forward_kinematics(TwoArmTorso{}, bent, std::string(side) + "_forearm_link").translation();
    CHECK(hand.x() - elbow.x() == Approx(0.25 * std::sin(1.5)));
  }
}

TEST_CASE("The torso's arms are mirror images and do not feel each other") {
  const JointVector<6> q{0.4, 0.3, 1.2, 0.4, -0.3, 1.2}, v{1, -2, 0.5, 1, 2, 0.5};
  const JointVector<6> effort = nonlinear_effects(TwoArmTorso{}, q, v);
  CHECK(effort[3] == Approx(effort[0]));  // pitch and elbow alike, roll mirrored
  CHECK(effort[4] == Approx(-effort[1]));
  CHECK(effort[5] == Approx(effort[2]));
  const JointMatrix<6> mass = mass_matrix(TwoArmTorso{}, q);
  CHECK((mass.topRightCorner<3, 3>().array() == 0).all());
}
