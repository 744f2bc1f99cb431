// SPDX-License-Identifier: Apache-2.0
/// @file Conversion of urdfdom's links and joints to articula's.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/joint.hpp"
#include "articula/model/link.hpp"
#include "articula/urdf/xml/document.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace articula {

/// The limits of a joint: those of <limit>, narrowed by those of its commands in <ros2_control>,
/// and the soft limits of <safety_controller>.
/// @return  [rad, rad/s, N m] or [m, m/s, N]; infinite where there is no limit
/// Real-time: no (searches by name).
[[nodiscard]] inline JointLimits joint_limits(const UrdfDocument& document,
                                              const urdf::Joint& joint) {
  JointLimits limits;
  const bool unbounded = joint.type == urdf::Joint::CONTINUOUS;
  if (joint.limits) {
    limits.velocity = joint.limits->velocity;
    limits.effort = joint.limits->effort;
    if (!unbounded) {
      limits.lower = joint.limits->lower;
      limits.upper = joint.limits->upper;
    }
  }
  if (const auto found = document.control.limits.find(joint.name);
      found != document.control.limits.end()) {
    const JointLimits& command = found->second;
    limits.velocity = std::min(limits.velocity, command.velocity);
    limits.effort = std::min(limits.effort, command.effort);
    limits.acceleration = command.acceleration;
    limits.jerk = command.jerk;
    if (!unbounded) {
      limits.lower = std::max(limits.lower, command.lower);
      limits.upper = std::min(limits.upper, command.upper);
    }
    if (command.soft_lower <= limits.upper && command.soft_upper >= limits.lower) {
      limits.soft_lower = command.soft_lower;
      limits.soft_upper = command.soft_upper;
      limits.soft_rate = command.soft_rate;
    }  // else UrdfNotices reports them
  }
  return limits;
}

namespace detail {

/// @throws FileError if a name is too long
[[nodiscard]] inline Name name_of(const UrdfDocument& document, const std::string& text) {
  if (text.size() > Name::capacity) {
    throw FileError(document.file, "'" + text + "': the name has " + std::to_string(text.size()) +
                                       " characters; at most 63 are supported");
  }
  return std::string_view(text);
}

[[nodiscard]] inline Vector3<double> vector_of(const urdf::Vector3& a) { return {a.x, a.y, a.z}; }

[[nodiscard]] inline Link link_of(const UrdfDocument& document, const urdf::Link& link,
                                  bool without_mass) {
  Link result{.name = name_of(document, link.name)};
  if (without_mass || !link.inertial) return result;
  const urdf::Inertial& inertial = *link.inertial;
  result.mass = inertial.mass;
  result.center_of_mass = vector_of(inertial.origin.position);
  result.inertia = {inertial.ixx, inertial.ixy, inertial.ixz,
                    inertial.iyy, inertial.iyz, inertial.izz};
  result.inertia_orientation = document.inertia_orientations.at(link.name);
  return result;
}

[[nodiscard]] inline JointType type_of(const UrdfDocument& document, const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return JointType::revolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::continuous;
    case urdf::Joint::PRISMATIC:
      return JointType::prismatic;
    case urdf::Joint::FIXED:
      return JointType::fixed;
    default:
      throw FileError(
          document.file,
          "joint '" + joint.name + "': it is " +
              (joint.type == urdf::Joint::PLANAR ? "planar" : "floating") +
              ", but joints must have one degree of freedom: lock it, or choose a root beyond it");
  }
}

/// A joint as fixed at its zero position.
[[nodiscard]] inline Joint fixed_joint_of(const UrdfDocument& document, const urdf::Joint& joint) {
  return {.name = name_of(document, joint.name),
          .parent = name_of(document, joint.parent_link_name),
          .child = name_of(document, joint.child_link_name),
          .origin = vector_of(joint.parent_to_joint_origin_transform.position),
          .orientation = document.joint_orientations.at(joint.name)};
}

/// A joint without its mimic, see resolve_mimic, and with unchecked limits, see
/// check_command_limits.
[[nodiscard]] inline Joint joint_of(const UrdfDocument& document, const urdf::Joint& joint) {
  Joint result = fixed_joint_of(document, joint);
  result.type = type_of(document, joint);
  if (result.type == JointType::fixed) return result;
  result.axis = vector_of(joint.axis);
  result.limits = joint_limits(document, joint);
  if (joint.dynamics) {
    result.damping = joint.dynamics->damping;
    result.friction = joint.dynamics->friction;
  }
  return result;
}

/// The roll, pitch, yaw of a rotation [rad].
[[nodiscard]] inline Vector3<double> rpy_of(const Matrix3<double>& rotation) {
  const auto& [a, b, c] = rotation.rows;
  // Roll follows from the rotation and yaw, so that the three are consistent at a pitch of pi/2.
  const double yaw = std::atan2(b.x, a.x), sine = std::sin(yaw), cosine = std::cos(yaw);
  return {std::atan2(sine * a.z - cosine * b.z, cosine * b.y - sine * a.y),
          std::atan2(-c.x, std::hypot(a.x, b.x)), yaw};
}

/// A joint as fixed at a position [rad or m].
[[nodiscard]] inline Joint locked_joint_of(const UrdfDocument& document, const urdf::Joint& joint,
                                           double position) {
  Joint result = fixed_joint_of(document, joint);
  if (position == 0) return result;  // also planar and floating joints
  const Vector3<double> axis = vector_of(joint.axis);
  const double length = std::sqrt(dot(axis, axis));
  if (type_of(document, joint) == JointType::fixed || !(length > 0) || !is_finite(length)) {
    throw FileError(document.file, "joint '" + joint.name + "': it cannot be locked at " +
                                       rounded_text(position) +
                                       ": it is fixed or its axis has no direction");
  }
  const Matrix3<double> rotation = rotation_from_rpy(result.orientation);
  if (joint.type == urdf::Joint::PRISMATIC) {
    result.origin = result.origin + rotation * (position / length * axis);
  } else {
    const Matrix3<double> onto_axis = rotation_of_z_onto(direction_of(axis));
    const Matrix3<double> turn = turn_about_z(std::sin(position), std::cos(position));
    result.orientation = rpy_of(rotation * onto_axis * turn * onto_axis.transposed());
  }
  return result;
}

}  // namespace detail
}  // namespace articula
