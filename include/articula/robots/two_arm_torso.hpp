// SPDX-License-Identifier: Apache-2.0
/// @file A torso with two arms of three joints each.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/description_parts.hpp"
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
      upright_link(side("upper_arm_link"), 1.2, -0.13, {.xx = 0.0075, .yy = 0.0075, .zz = 0.0009}),
      upright_link(side("forearm_link"), 0.9, -0.12, {.xx = 0.0046, .yy = 0.0046, .zz = 0.0005}),
  }};
}

/// The joints of one arm of the torso.
constexpr std::array<Joint, 3> torso_arm_joints(Side side) {
  const Name shoulder = side("shoulder_link"), upper = side("upper_arm_link");
  return {{
      revolute_joint(side("shoulder_pitch_joint"), "torso_link", shoulder,
                     {0, side.sign * 0.18, 0.42}, {0, 1, 0}, symmetric_limits(3.14, 4, 30), 0.2),
      revolute_joint(side("shoulder_roll_joint"), shoulder, upper, {0, side.sign * 0.06, 0},
                     {1, 0, 0}, symmetric_limits(1.57, 4, 30), 0.2),
      revolute_joint(side("elbow_joint"), upper, side("forearm_link"), {0, 0, -0.28}, {0, -1, 0},
                     {.lower = 0, .upper = 2.356, .velocity = 5, .effort = 15}, 0.1),
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
      .links = detail::joined(std::array{Link{.name = "torso_link",
                                              .mass = 6.5,
                                              .center_of_mass = {0, 0, 0.22},
                                              .inertia = {.xx = 0.12, .yy = 0.1, .zz = 0.06}}},
                              detail::torso_arm_links({"left_", 1}),
                              detail::torso_arm_links({"right_", -1})),
      .joints = detail::joined(detail::torso_arm_joints({"left_", 1}),
                               detail::torso_arm_joints({"right_", -1}))};
};

/// The torso in simulation.
using TwoArmTorsoSim = Simulator<TwoArmTorso>;

}  // namespace articula
