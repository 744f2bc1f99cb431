// SPDX-License-Identifier: Apache-2.0
/// @file A robot as programs outside the loop see it.
#pragma once

#include "articula/model/joint.hpp"

#include <string>
#include <vector>

namespace articula::remote {

/// A joint that can be commanded.
struct SheetJoint {
  std::string name{};
  JointType type = JointType::revolute;
  JointLimits limits{};
  // Of trajectories that bring no tolerances. 0 is not checked.
  double path_tolerance = 0;    ///< before the end [rad or m]
  double goal_tolerance = 0;    ///< at the end [rad or m]
  double stopped_velocity = 0;  ///< at the end [rad/s or m/s]

  /// "rad" or "m".
  [[nodiscard]] std::string position_unit() const {
    return type == JointType::prismatic ? "m" : "rad";
  }
  /// "N m" or "N".
  [[nodiscard]] std::string effort_unit() const {
    return type == JointType::prismatic ? "N" : "N m";
  }
};

/// A joint that follows another one: q = multiplier q_mimicked + offset.
struct SheetMimic {
  std::string name{};
  int joint = 0;  ///< index of the mimicked joint in RobotSheet::joints
  double multiplier = 1;
  double offset = 0;
};

/// The link to which a link is attached.
struct SheetParent {
  int link = -1;          ///< index in RobotSheet::links; -1 for the root
  bool is_fixed = false;  ///< the link does not move in its parent's frame
};

/// What does not change while a loop runs: its robot, period and kind of command.
struct RobotSheet {
  std::string name{};
  std::vector<SheetJoint> joints{};  ///< in the order of all vectors of numbers
  std::vector<SheetMimic> mimics{};
  std::vector<std::string> links{};     ///< all links, the root first
  std::vector<SheetParent> parents{};   ///< of each link
  std::vector<std::string> commands{};  ///< the quantities of the loop's command, as "effort"
  std::string urdf{};                   ///< the robot as a URDF document, with visuals
  double period = 1e-3;                 ///< of the loop [s]
  double goal_time = 0;                 ///< to arrive after a trajectory [s]; 0: unlimited
  bool is_simulated = false;            ///< the requests for simulations are understood
};

}  // namespace articula::remote
