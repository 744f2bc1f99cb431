// SPDX-License-Identifier: Apache-2.0
/// @file Transmissions and initial values from a URDF.
#include <articula/hardware/transmission/urdf_gearing.hpp>
#include <articula/urdf/initial_values.hpp>
#include <articula/urdf/urdf.hpp>

#include "catch.hpp"
#include "urdf_text.hpp"

using namespace articula;
using Catch::Matchers::Contains;

namespace {

UrdfDescription described_with(const std::string& drives) {
  std::string text = support::pendulum();
  text.insert(text.rfind("</robot>"), drives);
  return read_urdf(text);
}

}  // namespace

TEST_CASE("A simple transmission has the reduction of its actuator, or of its joint") {
  const UrdfDescription old = read_urdf(URDF_FILES "/arm.urdf");
  const auto shoulder = gearing_of<SimpleTransmission>(old, "shoulder_transmission");
  CHECK(shoulder.joints[0] == Name("shoulder"));
  CHECK(shoulder.actuators[0] == Name("shoulder_motor"));
  CHECK(shoulder.transmission.reduction == 100.5);
  CHECK(shoulder.transmission.joint_offset == 0);

  const UrdfDescription fresh = described_with(
      "<ros2_control name=\"c\"><transmission name=\"t\"><plugin>p</plugin>"
      "<actuator name=\"motor\" role=\"actuator1\"/><joint name=\"pivot\" role=\"joint1\">"
      "<mechanical_reduction>-325.949</mechanical_reduction><offset>0.25</offset></joint>"
      "</transmission></ros2_control>");
  const auto pivot = gearing_of<SimpleTransmission>(fresh, "t");
  CHECK(pivot.transmission.reduction == -325.949);
  CHECK(pivot.transmission.joint_offset == 0.25);
}

TEST_CASE("Joints and actuators of a differential stand by their roles") {
  const UrdfDescription description = described_with(
      "<transmission name=\"wrist\"><actuator name=\"b\"><role>actuator2</role>"
      "<mechanicalReduction>20</mechanicalReduction></actuator><actuator name=\"a\">"
      "<role>actuator1</role><mechanicalReduction>-10</mechanicalReduction></actuator>"
      "<joint name=\"roll\"><role>joint2</role><offset>0.5</offset></joint><joint name=\"pivot\">"
      "<role>joint1</role><mechanicalReduction>3</mechanicalReduction></joint></transmission>");
  const auto wrist = gearing_of<DifferentialTransmission>(description, "wrist");
  CHECK(wrist.actuators == std::array<Name, 2>{"a", "b"});
  CHECK(wrist.joints == std::array<Name, 2>{"pivot", "roll"});
  CHECK(wrist.transmission.actuator_reduction == std::array{-10.0, 20.0});
  CHECK(wrist.transmission.joint_reduction == std::array{3.0, 1.0});
  CHECK(wrist.transmission.joint_offset == std::array{0.0, 0.5});
  CHECK(gearing_of<FourBarTransmission>(description, "wrist").transmission.joint_offset[1] == 0.5);
  CHECK_THROWS_WITH(gearing_of<SimpleTransmission>(description, "wrist"),
                    Contains("'wrist' has 2 joints instead of 1"));
}

TEST_CASE("Roles that do not tell which end is which are refused") {
  const auto wrist = [](const std::string& joint, const std::string& actuator) {
    return described_with(
        "<transmission name=\"wrist\"><actuator name=\"b\"><role>actuator2</role></actuator>"
        "<actuator name=\"a\">" +
        actuator + "</actuator><joint name=\"roll\"><role>joint2</role></joint>" +
        "<joint name=\"pivot\">" + joint + "</joint></transmission>");
  };
  const auto refusal_of = [](const UrdfDescription& description, const char* kind) {
    CHECK_THROWS_WITH(
        gearing_of<DifferentialTransmission>(description, "wrist"),
        Contains("'wrist'") && Contains("each " + std::string(kind) + " must have a role"));
  };
  const std::string first_joint = "<role>joint1</role>", first = "<role>actuator1</role>";
  CHECK_NOTHROW(gearing_of<DifferentialTransmission>(wrist(first_joint, first), "wrist"));
  refusal_of(wrist("", first), "joint");
  refusal_of(wrist("<role>joint2</role>", first), "joint");
  refusal_of(wrist(first_joint, ""), "actuator");
  refusal_of(wrist(first_joint, "<role>actuator2</role>"), "actuator");

  const UrdfDescription without = described_with(
      "<transmission name=\"wrist\"><actuator name=\"b\"/><actuator name=\"a\"/>"
      "<joint name=\"roll\"/><joint name=\"pivot\"/></transmission>");
  const auto as_written = gearing_of<DifferentialTransmission>(without, "wrist");
  CHECK(as_written.joints == std::array<Name, 2>{"roll", "pivot"});
  CHECK(as_written.actuators == std::array<Name, 2>{"b", "a"});
}

TEST_CASE("A transmission of another type than the file's is refused") {
  const auto typed = [](const std::string& type) {
    return described_with("<transmission name=\"wrist\"><type>" + type +
                          "</type><actuator name=\"a\"/><actuator name=\"b\"/>"
                          "<joint name=\"pivot\"/><joint name=\"roll\"/></transmission>");
  };
  const UrdfDescription differential = typed("transmission_interface/DifferentialTransmission");
  CHECK_NOTHROW(gearing_of<DifferentialTransmission>(differential, "wrist"));
  CHECK_THROWS_WITH(gearing_of<FourBarTransmission>(differential, "wrist"),
                    Contains("'wrist' is a DifferentialTransmission, not a FourBarLinkage"));
  const UrdfDescription linkage = typed("transmission_interface/FourBarLinkageTransmission");
  CHECK_NOTHROW(gearing_of<FourBarTransmission>(linkage, "wrist"));
  CHECK_THROWS_AS(gearing_of<DifferentialTransmission>(linkage, "wrist"), std::invalid_argument);
  CHECK_NOTHROW(gearing_of<FourBarTransmission>(typed("mine/WristTransmission"), "wrist"));
}

TEST_CASE("Transmissions that are missing or make no sense are refused, and named") {
  const UrdfDescription description = described_with(
      "<transmission name=\"stuck\"><actuator name=\"a\"/><joint name=\"pivot\"/>"
      "<mechanicalReduction>0</mechanicalReduction></transmission>");
  CHECK_THROWS_WITH(gearing_of<SimpleTransmission>(description, "shoulder"),
                    Contains("'shoulder' does not exist; the file has 'stuck'"));
  CHECK_THROWS_WITH(gearing_of<SimpleTransmission>(description, "stuck"),
                    Contains("'stuck'") && Contains("reduction 0"));
  CHECK_THROWS_WITH(described_with("<transmission name=\"t\"><actuator name=\"a\"/>"
                                   "<joint name=\"pivot\"><offset>much</offset></joint>"
                                   "</transmission>"),
                    Contains("transmission 't': offset: 'much'"));
}

TEST_CASE("A simulation starts at the initial values of ros2_control") {
  const UrdfDescription description = described_with(
      "<ros2_control name=\"c\"><joint name=\"pivot\"><state_interface name=\"position\">"
      "<param name=\"initial_value\">0.375</param></state_interface>"
      "<state_interface name=\"velocity\"><param name=\"initial_value\">-2</param>"
      "</state_interface><state_interface name=\"effort\">"
      "<param name=\"initial_value\">7</param></state_interface></joint></ros2_control>");
  const auto pendulum = load_urdf<1>(description);
  CHECK(initial_positions(pendulum, description)[0] == 0.375);
  CHECK(initial_velocities(pendulum, description)[0] == -2);

  UrdfContents contents = *description;
  contents.initial_values.clear();
  contents.joints[0].type = JointType::revolute;
  contents.joints[0].limits = {.lower = 0.5, .upper = 1};
  const UrdfDescription silent(contents);
  const auto raised = load_urdf<1>(silent);
  CHECK(initial_positions(raised, silent)[0] == 0.5);
  CHECK(initial_velocities(raised, silent)[0] == 0);
  contents.joints[0].damping = -3;  // changed contents are checked again
  CHECK_THROWS_WITH(UrdfDescription(contents),
                    Contains("'pivot'") && Contains("damping is negative") && Contains("-3"));
  CHECK_THROWS_WITH(
      described_with("<ros2_control name=\"c\"><joint name=\"pivot\"><state_interface "
                     "name=\"position\"><param name=\"initial_value\">nan</param>"
                     "</state_interface></joint></ros2_control>"),
      Contains("joint 'pivot': initial_value of position: 'nan'"));
}
