// SPDX-License-Identifier: Apache-2.0
// Files that are odd, but sane: as programs and people write them.
#include <articula/dynamics/dynamics.hpp>
#include <articula/model/urdf.hpp>

#include "catch.hpp"
#include "urdf_text.hpp"

#include <string>

using namespace articula;
using Catch::Contains;
using support::joint, support::robot, support::solid;

namespace {

/// A pendulum with a <ros2_control> whose joint has this inside.
std::string controlled(const std::string& inside) {
  return robot(
      "<link name=\"base\"/>" + solid("rod") +
      joint("pivot", "continuous", "base", "rod", "<limit effort=\"100\" velocity=\"3\"/>") +
      "<ros2_control name=\"c\" type=\"system\"><joint name=\"pivot\">" + inside +
      "</joint></ros2_control>");
}

JointLimits limits_with(const std::string& command) {
  const Model<1> model = load_urdf<1>(
      UrdfSource(controlled("<command_interface name=" + command + "</command_interface>")));
  return model.joints[0].limits;
}

std::string param(const std::string& name, const std::string& text) {
  return "<param name=\"" + name + "\">" + text + "</param>";
}

}  // namespace

TEST_CASE("numbers of commands with comments, infinities and white space") {
  CHECK(limits_with("\"effort\">" + param("max", "<!-- N m --> 87 \n")).effort == 87);
  CHECK(limits_with("\"effort\">" + param("max", "8<!-- . -->7")).effort == 87);
  CHECK(limits_with("\"effort\">" + param("max", "inf")).effort == 100);
  CHECK(limits_with("\"mode\">" + param("max", "auto")).effort == 100);
  CHECK_THROWS_WITH(limits_with("\"effort\">" + param("max", "much")),
                    Contains("effort max: 'much' is not a finite number"));
}

TEST_CASE("a drive that runs one way can move; of two bounds the narrower counts") {
  CHECK(limits_with("\"velocity\">" + param("min", "0") + param("max", "1")).velocity == 1);
  CHECK(limits_with("\"velocity\">" + param("min", "-1") + param("max", "0")).velocity == 1);
  CHECK(limits_with("\"velocity\">" + param("min", "-1") + param("max", "2")).velocity == 1);
  CHECK(limits_with("\"velocity\">" + param("min", "-2") + param("max", "1.5")).velocity == 1.5);
}

TEST_CASE("commands that are switched off for a whole joint bind nobody") {
  const std::string off = "<limits enable=\"false\"/><command_interface name=\"effort\">" +
                          param("max", "1") + "</command_interface>";
  CHECK(load_urdf<1>(UrdfSource(controlled(off))).joints[0].limits.effort == 100);
}

TEST_CASE("tabs and line ends between the numbers of an attribute") {
  const auto loaded = [](const std::string& xyz) {
    return load_urdf<1>(
        UrdfSource(support::pendulum(solid("rod"), joint("pivot", "continuous", "base", "rod",
                                                         "<origin xyz=\"" + xyz + "\"/>"))));
  };
  for (const std::string blank : {"\t", "\n", "\r\n", " \t "}) {
    const auto rod =
        forward_kinematics(loaded("1" + blank + "2" + blank + "3"), JointVector<1>(0.0), "rod");
    CHECK(rod.translation() == Eigen::Vector3d(1, 2, 3));
  }
}

TEST_CASE("a mimic joint may move a link without mass if the joint that it follows moves one") {
  const std::string file =
      robot("<link name=\"base\"/>" + solid("a") + "<link name=\"pad\"/>" +
            joint("i", "continuous", "base", "a") +
            joint("k", "continuous", "a", "pad", "<mimic joint=\"i\" multiplier=\"-1\"/>"));
  const auto model = load_urdf<1, 2>(UrdfSource(file));
  CHECK(mass_matrix(model, JointVector<1>(0.3))(0, 0) == Approx(1));
  // The other way round as well; but some mass there must be.
  const std::string follower = "<mimic joint=\"i\"/>";
  const auto turned = [&](const std::string& last) {
    return robot("<link name=\"base\"/><link name=\"a\"/>" + last +
                 joint("i", "continuous", "base", "a") +
                 joint("k", "continuous", "base", "b", follower));
  };
  CHECK_NOTHROW(load_urdf<1, 2>(UrdfSource(turned(solid("b")))));
  CHECK_THROWS_WITH((load_urdf<1, 2>(UrdfSource(turned("<link name=\"b\"/>")))),
                    Contains("joint 'i': the joint moves no link that has mass"));
}

TEST_CASE("inertia without mass is accepted when asked for") {
  const std::string disc =
      "<link name=\"rod\"><inertial><mass value=\"0\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" "
      "iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>";
  const UrdfSource file = UrdfSource(support::pendulum(disc));
  CHECK_THROWS_WITH(load_urdf<1>(file), Contains("has inertia but no mass"));
  const auto model = load_urdf<1>(file, {.allow_unphysical = true});
  CHECK(mass_matrix(model, JointVector<1>(0.0))(0, 0) == Approx(1));
}

TEST_CASE("a chain that is too long is refused, and not followed") {
  std::string inside = solid("l0");
  for (int i = 1; i < 4000; ++i) {
    const std::string name = std::to_string(i), before = std::to_string(i - 1);
    inside +=
        "<link name=\"l" + name + "\"/>" + joint("j" + name, "fixed", "l" + before, "l" + name);
  }
  CHECK_THROWS_WITH(read_urdf(UrdfSource(robot(inside))), Contains("lie in one chain"));
}

TEST_CASE("what is said of the robot names the robot") {
  const std::string file = "<robot name=\"base\"><link name=\"base\"/><link name=\"b\"/>" +
                           joint("base", "fixed", "base", "b") + "</robot>";
  CHECK_THROWS_WITH(read_urdf(UrdfSource(file)), Contains("robot 'base': no joint moves"));
}

TEST_CASE("mimics that leave a joint no room are reported") {
  const auto finger = [](const std::string& name, const std::string& link,
                         const std::string& mimic) {
    return joint(name, "prismatic", "base", link,
                 "<limit lower=\"0\" upper=\"0.04\" effort=\"1\" velocity=\"1\"/>" + mimic);
  };
  const UrdfDescription description = read_urdf(
      UrdfSource(robot("<link name=\"base\"/>" + solid("a") + solid("b") + finger("left", "a", "") +
                       finger("right", "b", "<mimic joint=\"left\" multiplier=\"-1\"/>"))));
  REQUIRE(description.notices.size() == 1);
  CHECK_THAT(description.notices[0], Contains("joint 'left'") && Contains("mimic"));
}
