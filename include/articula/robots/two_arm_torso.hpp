// SPDX-License-Identifier: Apache-2.0
/// @file A torso with two arms of three joints each.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/sides.hpp"
#include "articula/sim/simulator.hpp"

#include <array>

namespace articula {

namespace detail {

/// The links of one arm of the torso.
constexpr std::array<Link, 3> torso_arm_links(Side side) {
  return {{
      {.name = side("shoulder_link"),
       .mass = 0.45,
       .center_of_mass = {0, side.sign * 0.03, 0},
       .inertia = {.xx = 0.0003, .yy = 0.0004, .zz = 0.0003}},
      {.name = side("upper_arm_link"),
       .mass = 1.2,
       .center_of_mass = {0, 0, -0.13},
       .inertia = {.xx = 0.0075, .yy = 0.0075, .zz = 0.0009}},
      {.name = side("forearm_link"),
       .mass = 0.9,
       .center_of_mass = {0, 0, -0.12},
       .inertia = {.xx = 0.0046, .yy = 0.0046, .zz = 0.0005}},
  }};
}

/// The joints of one arm of the torso.
constexpr std::array<Joint, 3> torso_arm_joints(Side side) {
  return {{
      {.name = side("shoulder_pitch_joint"),
       .type = JointType::revolute,
       .parent = "torso_link",
       .child = side("shoulder_link"),
       .origin = {0, side.sign * 0.18, 0.42},
       .axis = {0, 1, 0},
       .limits = {.lower = -3.14, .upper = 3.14, .velocity = 4, .effort = 30},
       .damping = 0.2},
      {.name = side("shoulder_roll_joint"),
       .type = JointType::revolute,
       .parent = side("shoulder_link"),
       .child = side("upper_arm_link"),
       .origin = {0, side.sign * 0.06, 0},
       .axis = {1, 0, 0},
       .limits = {.lower = -1.57, .upper = 1.57, .velocity = 4, .effort = 30},
       .damping = 0.2},
      {.name = side("elbow_joint"),
       .type = JointType::revolute,
       .parent = side("upper_arm_link"),
       .child = side("forearm_link"),
       .origin = {0, 0, -0.28},
       .axis = {0, -1, 0},
       .limits = {.lower = 0, .upper = 2.356, .velocity = 5, .effort = 15},
       .damping = 0.1},
  }};
}

}  // namespace detail

/// A fixed torso with two arms: shoulder pitch, shoulder roll and elbow on either side. At zero the
/// arms hang down; x points forward, y to the left, and elbows bend forward. Limits: those of
/// teaching material for small humanoids; the other figures are invented for arms of that size.
struct TwoArmTorso {
  static constexpr RobotDescription description{
      .name = "two_arm_torso",
      .gravity = {0, 0, -9.81},
      .links =
          detail::joined(std::to_array<Link>({{.name = "torso_link",
                                               .mass = 6.5,
                                               .center_of_mass = {0, 0, 0.22},
                                               .inertia = {.xx = 0.12, .yy = 0.1, .zz = 0.06}}}),
                         detail::torso_arm_links(detail::Side{"left_", 1}),
                         detail::torso_arm_links(detail::Side{"right_", -1})),
      .joints = detail::joined(detail::torso_arm_joints(detail::Side{"left_", 1}),
                               detail::torso_arm_joints(detail::Side{"right_", -1}))};
};

/// The torso in simulation.
using TwoArmTorsoSim = Simulator<TwoArmTorso>;

}  // namespace articula
