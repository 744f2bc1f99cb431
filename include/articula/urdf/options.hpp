// SPDX-License-Identifier: Apache-2.0
/// @file Options of reading a URDF: the part of the robot, locked joints, accepted faults, gravity.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/vector3.hpp"

#include <string>
#include <utility>
#include <vector>

namespace articula {

/// A joint that is held at a position for good, as if it were fixed.
struct LockedJoint {
  std::string name;
  double position = 0;  ///< [rad or m]

  LockedJoint(std::string joint, double at = 0)  // NOLINT: a name is a joint locked at 0
      : name(std::move(joint)), position(at) {}
  LockedJoint(const char* joint, double at = 0)  // NOLINT: likewise
      : name(joint), position(at) {}
};

/// Options of reading a URDF.
///
///     load_urdf<7>("panda.urdf", {.locked = {{"panda_finger_joint1", 0.02}}});
struct UrdfOptions {
  /// Link that becomes the fixed base; only its descendants are read. Empty: the file's root
  std::string root{};
  /// Last link of a chain from the root. Branches from the chain are left out with their mass; a
  /// notice gives that mass. Empty: the whole tree
  std::string tip{};
  /// Joints to hold. Joints that mimic one of them are held as well, at the position that follows.
  /// A locked joint may be outside of the selected part. A position beyond the joint's limits is a
  /// notice
  std::vector<LockedJoint> locked{};
  /// Accept inertias that no real body has; each of them is a notice. Masses < 0 are never accepted
  bool allow_unphysical = false;
  /// Skip all masses: the robot has kinematics, but no dynamics. load_kinematic_urdf sets it
  bool kinematic = false;
  /// Acceleration of free fall in the root link's frame [m/s^2], 3 x 1
  Vector3<double> gravity{0, 0, -9.81};
  /// Tolerance for right angles that the file writes with few digits, 0 .. 0.1, dimensionless, see
  /// canonical_form; 0 uses every angle as it is written
  double right_angle_tolerance = default_right_angle_tolerance;
};

}  // namespace articula
