// SPDX-License-Identifier: Apache-2.0
/// @file What articula_add_robot makes of a URDF at build time is what load_urdf makes at run time.
#include <articula/dynamics/dynamics.hpp>
#include <articula/urdf/urdf.hpp>

#include <arm.hpp>
#include <arm_as_written.hpp>
#include <arm_chain.hpp>
#include <gripper.hpp>
#include <locked_gripper.hpp>
#include <unphysical.hpp>

#include "catch.hpp"
#include "same_description.hpp"

using namespace articula;

static_assert(joint_count<made::Arm> == 3);
static_assert(made::Arm::description.right_angle_tolerance == default_right_angle_tolerance);
static_assert(made::ArmAsWritten::description.right_angle_tolerance == 0);
static_assert(joint_count<made::Gripper> == 2);
static_assert(joint_names(made::LockedGripper{})[0] == "left_knuckle");
static_assert(joint_names(ArmChain{})[1] == "lift");
static_assert(made::deep::Unphysical::description.allow_unphysical);

TEST_CASE("Descriptions made at build time and read at run time are the same, bit for bit") {
  const std::string folder = URDF_FILES;
  CHECK(support::same(made::Arm::description, read_urdf(folder + "/arm.urdf")));
  CHECK(support::same(made::ArmAsWritten::description,
                      read_urdf(folder + "/arm.urdf", {.right_angle_tolerance = 0})));
  CHECK(support::same(made::Gripper::description, read_urdf(folder + "/gripper.urdf")));
  CHECK(support::same(made::LockedGripper::description,
                      read_urdf(folder + "/gripper.urdf",
                                {.locked = {{"wrist", 0.75}}, .gravity = {0, 0, -1.62}})));
  CHECK(support::same(ArmChain::description,
                      read_urdf(folder + "/arm.urdf", {.root = "column", .tip = "tool"})));
  CHECK(support::same(made::deep::Unphysical::description,
                      read_urdf(folder + "/unphysical.urdf", {.allow_unphysical = true})));
}

TEST_CASE("Robots made at build time and loaded at run time move alike") {
  const JointVector<2> q{0.3, 0.5}, v{1, -2}, a{5, 3};
  const auto loaded = load_urdf<2, 5>(URDF_FILES "/gripper.urdf");
  // The compiler may order the operations differently.
  CHECK((inverse_dynamics(made::Gripper{}, q, v, a) - inverse_dynamics(loaded, q, v, a)).norm() <
        1e-13);
}

TEST_CASE("Right angles written with few digits are taken as such within the tolerance alone") {
  // 1.5707963 is 2.7e-8 off. By how much it is, efforts differ, and an exact one saves operations.
  const JointVector<3> q{0.3, 0.5, -0.2}, v{1, -2, 0.5}, a{5, 3, -1};
  const JointVector<3> rounded = inverse_dynamics(made::Arm{}, q, v, a),
                       as_written = inverse_dynamics(made::ArmAsWritten{}, q, v, a);
  CHECK((rounded - as_written).norm() < 1e-6 * as_written.norm());
  CHECK((rounded - as_written).norm() > 1e-12 * as_written.norm());
  CHECK(operations<InverseDynamics, made::Arm>().multiplications <
        operations<InverseDynamics, made::ArmAsWritten>().multiplications);
}
