// SPDX-License-Identifier: Apache-2.0
/// @file The Franka Emika Panda, an arm with seven revolute joints and a hand.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/description_parts.hpp"
#include "articula/sim/simulator.hpp"

#include <array>
#include <numbers>

namespace articula {

namespace detail {

constexpr std::array<Joint, 12> panda_joints() {
  // Each axis is z of a frame that is rolled by a right angle against the one before.
  const auto arm_joint = [](const Name& name, const Name& parent, const Name& child,
                            const Vector3<double>& origin, double roll, const JointLimits& limits) {
    Joint joint = revolute_joint(name, parent, child, origin, {0, 0, 1}, limits, 0.003);
    joint.orientation.x = roll;
    return joint;
  };
  const double right_angle = std::numbers::pi / 2;
  Joint hand = fixed_joint("panda_hand_joint", "panda_link8", "panda_hand");
  hand.orientation.z = -std::numbers::pi / 4;
  return {{
      arm_joint("panda_joint1", "panda_link0", "panda_link1", {0, 0, 0.333}, 0,
                symmetric_limits(2.8973, 2.175, 87)),
      arm_joint("panda_joint2", "panda_link1", "panda_link2", {}, -right_angle,
                symmetric_limits(1.7628, 2.175, 87)),
      arm_joint("panda_joint3", "panda_link2", "panda_link3", {0, -0.316, 0}, right_angle,
                symmetric_limits(2.8973, 2.175, 87)),
      arm_joint("panda_joint4", "panda_link3", "panda_link4", {0.0825, 0, 0}, right_angle,
                {.lower = -3.0718, .upper = -0.0698, .velocity = 2.175, .effort = 87}),
      arm_joint("panda_joint5", "panda_link4", "panda_link5", {-0.0825, 0.384, 0}, -right_angle,
                symmetric_limits(2.8973, 2.61, 12)),
      arm_joint("panda_joint6", "panda_link5", "panda_link6", {}, right_angle,
                {.lower = -0.0175, .upper = 3.7525, .velocity = 2.61, .effort = 12}),
      arm_joint("panda_joint7", "panda_link6", "panda_link7", {0.088, 0, 0}, right_angle,
                symmetric_limits(2.8973, 2.61, 12)),
      fixed_joint("panda_joint8", "panda_link7", "panda_link8", {0, 0, 0.107}),
      hand,
      fixed_joint("panda_hand_tcp_joint", "panda_hand", "panda_hand_tcp", {0, 0, 0.1034}),
      fixed_joint("panda_finger_joint1", "panda_hand", "panda_leftfinger", {0, 0, 0.0584}),
      fixed_joint("panda_finger_joint2", "panda_hand", "panda_rightfinger", {0, 0, 0.0584}),
  }};
}

}  // namespace detail

/// The Franka Emika Panda with its hand: seven revolute joints; the two fingers are locked where
/// they meet. Figures: the public robot description of franka_ros (franka_description).
struct Panda {
  static constexpr RobotDescription description{
      .name = "panda",
      .gravity = {0, 0, -9.81},
      .links = std::to_array<Link>({
          {.name = "panda_link0",
           .mass = 0.629769,
           .center_of_mass = {-0.041018, -0.00014, 0.049974},
           .inertia = {.xx = 0.00315,
                       .xy = 8.2904e-07,
                       .xz = 0.00015,
                       .yy = 0.00388,
                       .yz = 8.2299e-06,
                       .zz = 0.004285}},
          {.name = "panda_link1",
           .mass = 4.970684,
           .center_of_mass = {0.003875, 0.002081, -0.04762},
           .inertia = {.xx = 0.70337,
                       .xy = -0.000139,
                       .xz = 0.006772,
                       .yy = 0.70661,
                       .yz = 0.019169,
                       .zz = 0.009117}},
          {.name = "panda_link2",
           .mass = 0.646926,
           .center_of_mass = {-0.003141, -0.02872, 0.003495},
           .inertia = {.xx = 0.007962,
                       .xy = -0.003925,
                       .xz = 0.010254,
                       .yy = 0.02811,
                       .yz = 0.000704,
                       .zz = 0.025995}},
          {.name = "panda_link3",
           .mass = 3.228604,
           .center_of_mass = {0.027518, 0.039252, -0.066502},
           .inertia = {.xx = 0.037242,
                       .xy = -0.004761,
                       .xz = -0.011396,
                       .yy = 0.036155,
                       .yz = -0.012805,
                       .zz = 0.01083}},
          {.name = "panda_link4",
           .mass = 3.587895,
           .center_of_mass = {-0.05317, 0.104419, 0.027454},
           .inertia = {.xx = 0.025853,
                       .xy = 0.007796,
                       .xz = -0.001332,
                       .yy = 0.019552,
                       .yz = 0.008641,
                       .zz = 0.028323}},
          {.name = "panda_link5",
           .mass = 1.225946,
           .center_of_mass = {-0.011953, 0.041065, -0.038437},
           .inertia = {.xx = 0.035549,
                       .xy = -0.002117,
                       .xz = -0.004037,
                       .yy = 0.029474,
                       .yz = 0.000229,
                       .zz = 0.008627}},
          {.name = "panda_link6",
           .mass = 1.666555,
           .center_of_mass = {0.060149, -0.014117, -0.010517},
           .inertia = {.xx = 0.001964,
                       .xy = 0.000109,
                       .xz = -0.001158,
                       .yy = 0.004354,
                       .yz = 0.000341,
                       .zz = 0.005433}},
          {.name = "panda_link7",
           .mass = 0.735522,
           .center_of_mass = {0.010517, -0.004252, 0.061597},
           .inertia = {.xx = 0.012516,
                       .xy = -0.000428,
                       .xz = -0.001196,
                       .yy = 0.010027,
                       .yz = -0.000741,
                       .zz = 0.004815}},
          {.name = "panda_link8"},
          {.name = "panda_hand",
           .mass = 0.73,
           .center_of_mass = {-0.01, 0, 0.03},
           .inertia = {.xx = 0.001, .yy = 0.0025, .zz = 0.0017}},
          {.name = "panda_hand_tcp"},
          detail::upright_link("panda_leftfinger", 0.015, 0,
                               {.xx = 2.375e-06, .yy = 2.375e-06, .zz = 7.5e-07}),
          detail::upright_link("panda_rightfinger", 0.015, 0,
                               {.xx = 2.375e-06, .yy = 2.375e-06, .zz = 7.5e-07}),
      }),
      .joints = detail::panda_joints()};
};

/// The arm in simulation.
using PandaSim = Simulator<Panda>;

}  // namespace articula
