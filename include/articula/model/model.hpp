// SPDX-License-Identifier: Apache-2.0
/// @file A robot as a value: its mechanism, the properties of its joints, the frames of its links.
#pragma once

#include "articula/core/name.hpp"
#include "articula/model/joint_properties.hpp"
#include "articula/model/mechanism.hpp"

#include <vector>

namespace articula {

/// Where a link's frame stands: on which moving body, and where in its frame.
struct LinkFrame {
  Name name{};
  int body = -1;                  ///< index of the moving body; -1 for the fixed base
  Placement<double> placement{};  ///< the link's frame in the body's (or the base's) frame
  Name carrier{};                 ///< the joint, fixed or not, that carries it; empty for the root
};

/// A robot as a value, made from a description by build_model. Its parts depend on each other: for
/// a robot with other figures, build another model.
/// @tparam N           number of joints that can be commanded: moving ones that mimic no other
/// @tparam Bodies      number of moving bodies: N and one for each mimic joint
/// @tparam LinkFrames  container of LinkFrame: an array where the robot is known at compile time
/// @tparam Kinematic   whether its masses are not known, see KinematicModel
template <int N, int Bodies = N, class LinkFrames = std::vector<LinkFrame>, bool Kinematic = false>
struct Model {
  static constexpr int joint_count = N;
  static constexpr int body_count = Bodies;
  static constexpr bool kinematic = Kinematic;

  Name name{};
  Mechanism<N, Bodies> mechanism{};  ///< the bodies as described; link frames refer to it
  Mechanism<N, Bodies> canonical{};  ///< an equivalent one with shorter equations of motion
  JointArray<JointProperties, N> joints{};
  /// Names of the joints that carry the bodies, those that mimic others included
  JointArray<Name, Bodies> moving_joints{};
  LinkFrames links{};  ///< all links of the description, those welded to others included
};

/// A Model of a robot whose masses are not known. Kinematics, profiles, loops of positions and
/// velocities, and mocks take it as any robot. What needs dynamics does not compile with it. No
/// Model can be made of it by mistake: it is another type.
template <int N, int Bodies = N, class LinkFrames = std::vector<LinkFrame>>
using KinematicModel = Model<N, Bodies, LinkFrames, true>;

}  // namespace articula
