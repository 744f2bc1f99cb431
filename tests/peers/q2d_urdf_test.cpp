// SPDX-License-Identifier: Apache-2.0
// examples/q2d/q2d.urdf, read by ROS' own parser, against articula::Q2d: the same to the last bit.
#include "catch.hpp"
#include "eigen.hpp"

#include <articula/robots/q2d.hpp>

#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <string>

using namespace articula;

namespace {

std::string text(const Name& name) { return std::string(name.view()); }

void check_vector(const urdf::Vector3& theirs, const Vector3<double>& ours) {
  CHECK(theirs.x == ours.x);
  CHECK(theirs.y == ours.y);
  CHECK(theirs.z == ours.z);
}

/// urdfdom keeps rotations as quaternions; right only to rounding, but the Q2D has none.
void check_rotation(const urdf::Rotation& theirs, const Vector3<double>& rpy) {
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(theirs.w, theirs.x, theirs.y, theirs.z).toRotationMatrix();
  CHECK(support::distance(turn, support::rotation_of_rpy(rpy)) < 1e-14);
}

/// urdfdom does not read the ros2_control block.
const TiXmlElement& control_of(TiXmlDocument& document, const Name& joint) {
  REQUIRE(document.LoadFile(Q2D_URDF));
  const TiXmlElement* control = document.RootElement()->FirstChildElement("ros2_control");
  REQUIRE(control);
  for (const TiXmlElement* e = control->FirstChildElement("joint"); e;
       e = e->NextSiblingElement("joint")) {
    if (e->Attribute("name") == text(joint)) return *e;
  }
  FAIL("ros2_control has no joint " << text(joint));
  return *control;
}

double parameter(const TiXmlElement& interface, const std::string& name) {
  for (const TiXmlElement* e = interface.FirstChildElement("param"); e;
       e = e->NextSiblingElement("param")) {
    if (e->Attribute("name") == name) return std::stod(e->GetText());
  }
  FAIL("no parameter " << name);
  return 0;
}

}  // namespace

TEST_CASE("the Q2D's URDF has the description's links") {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(Q2D_URDF);
  REQUIRE(model);
  CHECK(model->getName() == text(Q2d::description.name));
  CHECK(model->getRoot()->name == "origin_link");
  CHECK(model->links_.size() == Q2d::description.links.size());
  for (const Link& ours : Q2d::description.links) {
    CAPTURE(text(ours.name));
    const urdf::LinkConstSharedPtr theirs = model->getLink(text(ours.name));
    REQUIRE(theirs);
    if (!theirs->inertial) {
      CHECK(ours.mass == 0);
      continue;
    }
    const urdf::Inertial& inertial = *theirs->inertial;
    CHECK(inertial.mass == ours.mass);
    check_vector(inertial.origin.position, ours.center_of_mass);
    check_rotation(inertial.origin.rotation, ours.inertia_orientation);
    CHECK(inertial.ixx == ours.inertia.xx);
    CHECK(inertial.ixy == ours.inertia.xy);
    CHECK(inertial.ixz == ours.inertia.xz);
    CHECK(inertial.iyy == ours.inertia.yy);
    CHECK(inertial.iyz == ours.inertia.yz);
    CHECK(inertial.izz == ours.inertia.zz);
  }
}

TEST_CASE("the Q2D's URDF has the description's joints") {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(Q2D_URDF);
  REQUIRE(model);
  CHECK(model->joints_.size() == Q2d::description.joints.size());
  for (const Joint& ours : Q2d::description.joints) {
    CAPTURE(text(ours.name));
    const urdf::JointConstSharedPtr theirs = model->getJoint(text(ours.name));
    REQUIRE(theirs);
    CHECK(theirs->parent_link_name == text(ours.parent));
    CHECK(theirs->child_link_name == text(ours.child));
    check_vector(theirs->parent_to_joint_origin_transform.position, ours.origin);
    check_rotation(theirs->parent_to_joint_origin_transform.rotation, ours.orientation);
    if (ours.type == JointType::fixed) {
      CHECK(theirs->type == urdf::Joint::FIXED);
      continue;
    }
    CHECK(ours.type == JointType::revolute);
    CHECK(theirs->type == urdf::Joint::REVOLUTE);
    check_vector(theirs->axis, ours.axis);
    REQUIRE(theirs->limits);
    CHECK(theirs->limits->lower == ours.limits.lower);
    CHECK(theirs->limits->upper == ours.limits.upper);
    CHECK(theirs->limits->velocity == ours.limits.velocity);
    CHECK(theirs->limits->effort == ours.limits.effort);
    REQUIRE(theirs->dynamics);
    CHECK(theirs->dynamics->damping == ours.damping);
    CHECK(theirs->dynamics->friction == ours.friction);
  }
}

TEST_CASE("the Q2D's URDF limits the effort command of ros2_control as the description does") {
  int moving = 0;
  for (const Joint& ours : Q2d::description.joints) {
    if (ours.type == JointType::fixed) continue;
    ++moving;
    CAPTURE(text(ours.name));
    TiXmlDocument document;
    const TiXmlElement& joint = control_of(document, ours.name);
    const TiXmlElement* command = joint.FirstChildElement("command_interface");
    REQUIRE(command);
    CHECK(std::string(command->Attribute("name")) == "effort");
    CHECK_FALSE(command->NextSiblingElement("command_interface"));
    CHECK(parameter(*command, "min") == -ours.limits.effort);
    CHECK(parameter(*command, "max") == ours.limits.effort);
    std::vector<std::string> states;
    for (const TiXmlElement* e = joint.FirstChildElement("state_interface"); e;
         e = e->NextSiblingElement("state_interface")) {
      states.emplace_back(e->Attribute("name"));
    }
    CHECK(states == std::vector<std::string>{"position", "velocity", "effort"});
  }
  CHECK(moving == 2);
}

TEST_CASE("the Q2D's URDF drives each moving joint through a gear of 1") {
  TiXmlDocument document;
  REQUIRE(document.LoadFile(Q2D_URDF));
  std::vector<std::string> joints;
  for (const TiXmlElement* e = document.RootElement()
                                   ->FirstChildElement("ros2_control")
                                   ->FirstChildElement("transmission");
       e; e = e->NextSiblingElement("transmission")) {
    const TiXmlElement* joint = e->FirstChildElement("joint");
    REQUIRE(joint);
    joints.emplace_back(joint->Attribute("name"));
    CHECK(std::stod(joint->FirstChildElement("mechanical_reduction")->GetText()) == 1);
    CHECK(std::string(e->FirstChildElement("plugin")->GetText()) ==
          "transmission_interface/SimpleTransmission");
  }
  CHECK(joints == std::vector<std::string>{"shoulder_active_joint", "elbow_active_joint"});
}
