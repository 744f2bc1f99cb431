// SPDX-License-Identifier: Apache-2.0
/// @file A joint of a robot's description, and the properties of one that can be commanded.
#pragma once

#include "articula/core/name.hpp"
#include "articula/model/vector3.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace articula {

/// The kinds of motion of a joint.
enum class JointType : unsigned char {
  revolute,    ///< rotates about its axis within limits
  continuous,  ///< rotates about its axis without limits
  prismatic,   ///< translates along its axis within limits
  fixed,       ///< does not move
};

/// The limits of a joint and its drive; infinite unless set.
struct JointLimits {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double lower = -infinity;        ///< lowest position [rad or m]
  double upper = infinity;         ///< highest position [rad or m]
  double velocity = infinity;      ///< highest speed in either direction [rad/s or m/s]
  double effort = infinity;        ///< highest effort in either direction [N m or N]
  double acceleration = infinity;  ///< highest, in either direction [rad/s^2 or m/s^2]
  double jerk = infinity;          ///< highest, in either direction [rad/s^3 or m/s^3]

  /// Soft limits of position before the limits, towards which the speed is limited, see
  /// CommandLimits [rad or m]
  double soft_lower = -infinity;
  double soft_upper = infinity;
  double soft_rate = infinity;  ///< highest speed over distance from the soft limit [1/s]

  friend bool operator==(const JointLimits&, const JointLimits&) = default;
};

/// The coupling of a mimic joint: q = multiplier q_mimicked + offset.
struct Mimic {
  Name joint{};           ///< name of the mimicked joint; empty: none
  double multiplier = 1;  ///< [1], or [m/rad] and the like between joints of different kinds
  double offset = 0;      ///< [rad or m]
};

/// The inertia of rotors that two joints turn together, as in a four-bar transmission: an element
/// of the mass matrix off its diagonal. One of the two joints names the other.
struct SharedRotors {
  Name joint{};  ///< name of the other joint; empty: none
  /// Sum of J n n' over the rotors of both joints, of either sign [kg m^2, kg m or kg]. A rotor of
  /// inertia J turns n and n' times as fast as the two joints
  double inertia = 0;
};

/// A joint as URDF describes it: it carries the child link in the parent link.
struct Joint {
  Name name{};  ///< unique among the joints
  JointType type = JointType::fixed;
  Name parent{};                  ///< name of its parent link
  Name child{};                   ///< name of its child link
  Vector3<double> origin{};       ///< position in the parent's frame [m], 3 x 1
  Vector3<double> orientation{};  ///< roll, pitch, yaw in the parent's frame [rad], 3 x 1
  Vector3<double> axis{1, 0, 0};  ///< direction in the joint's frame, of any length > 0, 3 x 1
  JointLimits limits{};
  double damping = 0;   ///< viscous friction [N m s/rad or N s/m]
  double friction = 0;  ///< Coulomb friction [N m or N]
  /// Inertia of the drive about the joint: n^2 J for a rotor with the inertia J that turns n times
  /// as fast as the joint [kg m^2 or kg]
  double reflected_inertia = 0;
  Mimic mimic{};
  SharedRotors shared_rotors{};  ///< see reflected_inertia of a transmission
};

/// The name, limits and friction of a joint that can be commanded. If other joints mimic it, its
/// limits, damping and friction include theirs; its soft limits and effort limit do not.
struct JointProperties {
  Name name{};
  JointType type = JointType::revolute;
  JointLimits limits{};
  double damping = 0;   ///< viscous friction [N m s/rad or N s/m]
  double friction = 0;  ///< Coulomb friction [N m or N]
};

namespace detail {

/// The limits of a joint without those of its mimics.
constexpr JointLimits own_limits(const Joint& joint) {
  JointLimits limits = joint.limits;
  if (joint.type == JointType::continuous) {
    limits.lower = -JointLimits::infinity;
    limits.upper = JointLimits::infinity;
    limits.soft_lower = -JointLimits::infinity;
    limits.soft_upper = JointLimits::infinity;
  }
  return limits;
}

}  // namespace detail

/// The properties of a joint that mimics no other. Its limits are narrowed so that the joints which
/// mimic it stay within theirs. Their damping and friction are added, converted by equal power.
/// @param joints  all joints of the description
/// @param joint   one of them
/// @return        with lower limit above upper limit if the limits have no position in common
[[nodiscard]] constexpr JointProperties properties_of(std::span<const Joint> joints,
                                                      const Joint& joint) {
  JointLimits limits = detail::own_limits(joint);
  double damping = joint.damping, friction = joint.friction;
  for (const Joint& other : joints) {
    if (other.type == JointType::fixed || !(other.mimic.joint == joint.name)) continue;
    const auto [name, multiplier, offset] = other.mimic;
    const double size = detail::magnitude(multiplier);
    damping += size * size * other.damping;
    friction += size * other.friction;
    const JointLimits own = detail::own_limits(other);
    if (size == 0) {  // it stays at its offset
      if (offset >= own.lower && offset <= own.upper) continue;
      limits.lower = JointLimits::infinity;
      limits.upper = -JointLimits::infinity;
      continue;
    }
    const double a = (own.lower - offset) / multiplier, b = (own.upper - offset) / multiplier;
    limits.lower = std::max(limits.lower, std::min(a, b));
    limits.upper = std::min(limits.upper, std::max(a, b));
    limits.velocity = std::min(limits.velocity, own.velocity / size);
    limits.acceleration = std::min(limits.acceleration, own.acceleration / size);
    limits.jerk = std::min(limits.jerk, own.jerk / size);
  }
  return {joint.name, joint.type, limits, damping, friction};
}

}  // namespace articula
