// SPDX-License-Identifier: Apache-2.0
/// @file A joint of a robot's description.
#pragma once

#include "articula/core/name.hpp"
#include "articula/model/vector3.hpp"

#include <limits>

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

/// The inertia of rotors that two joints turn together, as in a four-bar transmission: an element of
/// the mass matrix off its diagonal. One of the two joints names the other.
struct SharedRotors {
  Name joint{};  ///< name of the other joint; empty: none
  /// Sum of J n n' over the rotors that turn n and n' times as fast as the two joints, of either
  /// sign [kg m^2, kg m or kg]
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

}  // namespace articula
