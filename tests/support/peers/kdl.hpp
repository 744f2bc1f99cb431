// SPDX-License-Identifier: Apache-2.0
/// @file From a description to a robot of the Orocos Kinematics and Dynamics Library.
#pragma once

#include "robots/blueprint.hpp"

#include <kdl/frames.hpp>
#include <kdl/tree.hpp>

#include <stdexcept>
#include <string>

namespace support {

[[nodiscard]] inline KDL::Vector to_kdl(const articula::Vector3<double>& a) {
  return {a.x, a.y, a.z};
}
[[nodiscard]] inline KDL::Rotation to_kdl_rotation(const articula::Vector3<double>& rpy) {
  return KDL::Rotation::RPY(rpy.x, rpy.y, rpy.z);
}

[[nodiscard]] inline KDL::Segment to_kdl(const articula::Joint& joint,
                                         const articula::Link& child) {
  const KDL::Frame frame(to_kdl_rotation(joint.orientation), to_kdl(joint.origin));
  const KDL::Vector axis = frame.M * to_kdl(joint.axis);
  const std::string name(joint.name.view());
  const KDL::Joint kdl_joint =
      joint.type == articula::JointType::fixed
          ? KDL::Joint(name, KDL::Joint::Fixed)
          : KDL::Joint(name, frame.p, axis,
                       joint.type == articula::JointType::prismatic ? KDL::Joint::TransAxis
                                                                    : KDL::Joint::RotAxis);
  const articula::Symmetric3<double>& i = child.inertia;
  const KDL::Frame center(to_kdl_rotation(child.inertia_orientation), to_kdl(child.center_of_mass));
  const KDL::RigidBodyInertia inertia =
      center * KDL::RigidBodyInertia(child.mass, KDL::Vector::Zero(),
                                     KDL::RotationalInertia(i.xx, i.yy, i.zz, i.xy, i.xz, i.yz));
  return KDL::Segment(std::string(child.name.view()), kdl_joint, frame, inertia);
}

inline void add_children(KDL::Tree& tree, const Blueprint& robot, const articula::Name& link) {
  for (const articula::Joint& joint : robot.joints) {
    if (!(joint.parent == link)) continue;
    for (const articula::Link& child : robot.links) {
      if (!(child.name == joint.child)) continue;
      if (!tree.addSegment(to_kdl(joint, child), std::string(link.view()))) {
        throw std::logic_error("KDL refuses a segment");
      }
      add_children(tree, robot, child.name);
    }
  }
}

[[nodiscard]] inline KDL::Tree to_kdl(const Blueprint& robot, const articula::Name& root) {
  KDL::Tree tree{std::string(root.view())};
  add_children(tree, robot, root);
  return tree;
}

}  // namespace support
