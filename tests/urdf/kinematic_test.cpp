// SPDX-License-Identifier: Apache-2.0
/// @file Robots without masses load for functions that need no dynamics.
#include <articula/control/forward_position.hpp>
#include <articula/control/limits/limited.hpp>
#include <articula/dynamics/dynamics.hpp>
#include <articula/hardware/mock/mock_hardware.hpp>
#include <articula/loop/loop.hpp>
#include <articula/urdf/initial_values.hpp>
#include <articula/urdf/urdf.hpp>

#include <drawn.hpp>

#include "catch.hpp"
#include "same_description.hpp"
#include "urdf_text.hpp"

#include <cmath>
#include <string>

using namespace articula;
using Catch::Contains;
using support::joint;
using support::pendulum;

namespace {

constexpr const char* file = URDF_FILES "/massless.urdf";

std::string refusal(const UrdfSource& source, const UrdfOptions& options = {}) {
  try {
    static_cast<void>(read_urdf(source, options));
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A robot without masses has kinematics, joints and limits") {
  const KinematicModel<3, 4> robot = load_kinematic_urdf<3, 4>(file);
  CHECK(joint_names(robot)[2] == "fingers");
  CHECK(command_limits(robot).velocity == JointVector<3>(1.5, 2, 0.1));

  const double a = 0.3, b = -0.8;
  const JointVector<3> q(a, b, 0.02);
  const auto finger = forward_kinematics(robot, q, "right");
  // The finger lies 0.3 m beyond the elbow and 0.02 m to its right.
  CHECK(finger(0, 3) == Approx(0.4 * std::cos(a) + 0.3 * std::cos(a + b) + 0.02 * std::sin(a + b)));
  CHECK(finger(1, 3) == Approx(0.4 * std::sin(a) + 0.3 * std::sin(a + b) - 0.02 * std::cos(a + b)));
  CHECK(jacobian(robot, q, "hand")(1, 0) == Approx(0.4 * std::cos(a)));
}

TEST_CASE("The same robot made at build time is the same, and moves alike") {
  STATIC_REQUIRE(is_kinematic<made::Drawn>);
  CHECK(support::same(made::Drawn::description, read_urdf(file, {.kinematic = true})));
  const JointVector<3> q(0.3, -0.8, 0.02);
  const auto loaded = load_kinematic_urdf<3, 4>(file);
  CHECK(
      forward_kinematics(made::Drawn{}, q, "left")
          .isApprox(forward_kinematics(loaded, q, "left"), 1e-14));  // rounding of numbers below 1
}

TEST_CASE("Positions are controlled without masses") {
  using Arm = KinematicModel<3, 4>;
  using Drives = MockHardware<Arm, PositionCommand<3>>;
  const Arm arm = load_kinematic_urdf<3, 4>(file);
  Loop<Drives, ForwardPosition> loop{Drives{arm}, ForwardPosition<Arm>{arm}};
  REQUIRE(loop.hardware().activate() == Status::ok);
  loop.reference().position = JointVector<3>(0.5, 9, 0.01);  // the elbow ends at 2.5
  for (int k = 0; k < 3; ++k) REQUIRE(loop.update() == Status::ok);
  CHECK(loop.state().position == JointVector<3>(0.5, 2.5, 0.01));
}

TEST_CASE("The error about a robot without masses names load_kinematic_urdf") {
  const std::string advice =
      "without masses and dynamics, use load_kinematic_urdf (KINEMATIC in CMake, or articula run "
      "--mock)";
  CHECK_THAT(refusal(file), Contains("joint 'shoulder': the joint moves no link that has mass") &&
                                Contains(advice));
  const std::string bare = pendulum("<link name=\"rod\"/>");
  CHECK_THAT(refusal(bare), Contains("the joint moves no link that has mass") && Contains(advice));
  CHECK(refusal(bare, {.kinematic = true}).empty());
  // Other faults have nothing to do with masses.
  CHECK_THAT(refusal(support::robot("<link name=\"base\"/>")), !Contains("load_kinematic_urdf"));
  CHECK_THAT(
      refusal(pendulum("<link name=\"rod\"/>",
                       joint("pivot", "revolute", "base", "rod",
                             "<limit lower=\"2\" upper=\"1\" effort=\"1\" velocity=\"1\"/>")),
              {.kinematic = true}),
      Contains("the lower limit is above the upper limit"));
}

TEST_CASE("Skipped masses leave no trace and no notice") {
  const UrdfDescription drawn = read_urdf(file, {.kinematic = true});
  CHECK(drawn->notices.empty());
  for (const Link& link : drawn->links) CHECK(link.mass == 0);
  const UrdfDescription chain =
      read_urdf(URDF_FILES "/gripper.urdf", {.root = "palm", .kinematic = true});
  for (const std::string& notice : chain->notices) {
    CHECK_THAT(notice, !Contains("inerti") && !Contains("gravity") && !Contains("kg"));
  }
}

TEST_CASE("Invalid masses are no reason to refuse a kinematic robot") {
  for (const char* inside :
       {"", "<mass value=\"heavy\"/>", "<mass value=\"1\"/>", "<mass value=\"nan\"/>",
        "<mass value=\"-1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
        "izz=\"1\"/>"}) {
    const std::string text =
        pendulum(std::string("<link name=\"rod\"><inertial>") + inside + "</inertial></link>");
    CAPTURE(text);
    CHECK(!refusal(text, {.allow_unphysical = true}).empty());
    CHECK(load_kinematic_urdf<1>(text).links.size() == 2);
  }
}

TEST_CASE("A kinematic description makes no model with dynamics, a full one makes either") {
  CHECK_THROWS_WITH(
      (load_urdf<3, 4>(file, {.kinematic = true})),
      Contains("massless.urdf: it was read without masses") && Contains("load_kinematic_urdf"));
  const UrdfDescription full = read_urdf(pendulum());
  CHECK(load_kinematic_urdf<1>(full).joint_count == 1);
  CHECK_THROWS_WITH(load_kinematic_urdf<2>(full), Contains("load it with <1>, not <2>"));
}
