// SPDX-License-Identifier: Apache-2.0
/// @file Which part of a URDF to read, and how strictly.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/vector3.hpp"

#include <string>
#include <vector>

namespace articula {

/// A joint that is to be held in place for good, as if it were fixed.
struct LockedJoint {
  std::string name;
  double position = 0;  ///< where it is held [rad or m]

  LockedJoint(std::string joint, double at = 0)  // NOLINT: a name is a joint locked at 0
      : name(std::move(joint)), position(at) {}
  LockedJoint(const char* joint, double at = 0)  // NOLINT: likewise
      : name(joint), position(at) {}
};

/// Which part of a URDF to read, and how strictly.
///
///     load_urdf<7>("panda.urdf", {.locked = {{"panda_finger_joint1", 0.02}}});
struct UrdfOptions {
  std::string root{};  ///< link that becomes the fixed base; what is not beyond it is left out.
                       ///< Empty: the file's root
  std::string tip{};  ///< link at which a chain from the root ends; branches off the chain and what
                      ///< is beyond are left out with their mass, see UrdfDescription::notices.
                      ///< Empty: the whole tree
  /// Joints to hold. Joints that mimic one of them are held where it puts them, also if it is left
  /// out itself; a joint that mimics one that is left out and not held is an error. A place beyond
  /// a joint's limits is among UrdfDescription::notices
  std::vector<LockedJoint> locked{};
  bool allow_unphysical = false;  ///< accept inertias that no real body has; see
                                  ///< UrdfDescription::notices. Masses < 0 are never accepted
  bool kinematic = false;  ///< leave out all masses: the robot has kinematics, and no dynamics; see
                           ///< load_kinematic_urdf, which sets it
  /// Acceleration of free fall in the root link's frame [m/s^2], 3 x 1
  Vector3<double> gravity{0, 0, -9.81};
  /// What dynamics takes for a right angle that was written with few digits, see canonical_form;
  /// 0 takes every angle as it is written, 0.1 is the largest
  double right_angle_tolerance = default_right_angle_tolerance;
};

}  // namespace articula
