// SPDX-License-Identifier: Apache-2.0
/// @file A robot as a value: its mechanism, the properties of its joints and the frames of its links.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/name.hpp"
#include "articula/model/joint_properties.hpp"
#include "articula/model/mechanism.hpp"

#include <vector>

namespace articula {

/// The frame of a link: its moving body, and its placement on that body.
struct LinkFrame {
  Name name{};
  int body = -1;                  ///< index of the moving body; -1 for the fixed base
  Placement<double> placement{};  ///< in the frame of the body or of the base
  Name carrier{};                 ///< the joint of which it is the child; empty for the root
};

/// A robot as a value, made from a description by build_model. Its parts depend on each other: to
/// change a figure, build another model.
/// @tparam N           number of joints that can be commanded: those that move and mimic no other
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
  /// Names of the joints of the bodies, mimic joints included
  JointArray<Name, Bodies> moving_joints{};
  LinkFrames links{};  ///< all links of the description, welded ones included
};

/// A Model of a robot whose masses are not known. Kinematics, profiles, loops of positions and
/// velocities, and mocks accept it. Functions that need dynamics do not compile with it.
template <int N, int Bodies = N, class LinkFrames = std::vector<LinkFrame>>
using KinematicModel = Model<N, Bodies, LinkFrames, true>;

}  // namespace articula
