// SPDX-License-Identifier: Apache-2.0
/// @file Conversion of urdfdom's links and joints to articula's.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/model/link.hpp"
#include "articula/urdf/xml/document.hpp"

#include <Eigen/Geometry>

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
  }
  if (const auto soft = document.soft_limits.find(joint.name);
      soft != document.soft_limits.end() && soft->second.soft_lower <= limits.upper &&
      soft->second.soft_upper >= limits.lower) {  // else UrdfNotices reports them
    limits.soft_lower = soft->second.soft_lower;
    limits.soft_upper = soft->second.soft_upper;
    limits.soft_rate = soft->second.soft_rate;
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
[[nodiscard]] inline Vector3<double> rpy_of(const Eigen::Matrix3d& r) {
  // Roll follows from r and yaw, so that the three are consistent even at a pitch of pi/2.
  const double yaw = std::atan2(r(1, 0), r(0, 0)), s = std::sin(yaw), c = std::cos(yaw);
  return {std::atan2(s * r(0, 2) - c * r(1, 2), c * r(1, 1) - s * r(0, 1)),
          std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0))), yaw};
}

/// The rotation by roll, pitch and yaw [rad].
[[nodiscard]] inline Eigen::Matrix3d rotation_of(const Vector3<double>& rpy) {
  return (Eigen::AngleAxisd(rpy.z, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
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
  const Eigen::Vector3d along = Eigen::Vector3d(axis.x, axis.y, axis.z) / length;
  const Eigen::Matrix3d turn = rotation_of(result.orientation);
  if (joint.type == urdf::Joint::PRISMATIC) {
    const Eigen::Vector3d shift = turn * (position * along);
    result.origin = result.origin + Vector3<double>{shift.x(), shift.y(), shift.z()};
  } else {
    result.orientation = rpy_of(turn * Eigen::AngleAxisd(position, along).toRotationMatrix());
  }
  return result;
}

}  // namespace detail
}  // namespace articula
