// SPDX-License-Identifier: Apache-2.0
/// @file The Universal Robots UR10, an arm with six revolute joints.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/sim/simulator.hpp"

#include <array>
#include <numbers>

namespace articula {

/// The Universal Robots UR10: six revolute joints, the second to the fourth with parallel axes.
/// Figures: the public robot description of ROS-Industrial (ur_description).
struct Ur10 {
  static constexpr RobotDescription description{
      .name = "ur10",
      .gravity = {0, 0, -9.81},
      .links = std::to_array<Link>({
          {.name = "base_link",
           .mass = 4.0,
           .inertia = {.xx = 0.0061063308908, .yy = 0.0061063308908, .zz = 0.01125}},
          {.name = "shoulder_link",
           .mass = 7.778,
           .inertia = {.xx = 0.0314743125769, .yy = 0.0314743125769, .zz = 0.021875625}},
          {.name = "upper_arm_link",
           .mass = 12.93,
           .center_of_mass = {0, 0, 0.306},
           .inertia = {.xx = 0.421753803798, .yy = 0.421753803798, .zz = 0.036365625}},
          {.name = "forearm_link",
           .mass = 3.87,
           .center_of_mass = {0, 0, 0.28615},
           .inertia = {.xx = 0.111069694097, .yy = 0.111069694097, .zz = 0.010884375}},
          {.name = "wrist_1_link",
           .mass = 1.96,
           .inertia = {.xx = 0.0051082479567, .yy = 0.0051082479567, .zz = 0.0055125}},
          {.name = "wrist_2_link",
           .mass = 1.96,
           .inertia = {.xx = 0.0051082479567, .yy = 0.0051082479567, .zz = 0.0055125}},
          {.name = "wrist_3_link",
           .mass = 0.202,
           .inertia = {.xx = 0.000526462289415, .yy = 0.000526462289415, .zz = 0.000568125}},
          {.name = "tool0"},
      }),
      .joints = std::to_array<Joint>({
          {.name = "shoulder_pan_joint",
           .type = JointType::revolute,
           .parent = "base_link",
           .child = "shoulder_link",
           .origin = {0, 0, 0.1273},
           .axis = {0, 0, 1},
           .limits = {-2 * std::numbers::pi, 2 * std::numbers::pi, 2.16, 330}},
          {.name = "shoulder_lift_joint",
           .type = JointType::revolute,
           .parent = "shoulder_link",
           .child = "upper_arm_link",
           .origin = {0, 0.220941, 0},
           .orientation = {0, std::numbers::pi / 2, 0},
           .axis = {0, 1, 0},
           .limits = {-2 * std::numbers::pi, 2 * std::numbers::pi, 2.16, 330}},
          {.name = "elbow_joint",
           .type = JointType::revolute,
           .parent = "upper_arm_link",
           .child = "forearm_link",
           .origin = {0, -0.1719, 0.612},
           .axis = {0, 1, 0},
           .limits = {-std::numbers::pi, std::numbers::pi, 3.15, 150}},
          {.name = "wrist_1_joint",
           .type = JointType::revolute,
           .parent = "forearm_link",
           .child = "wrist_1_link",
           .origin = {0, 0, 0.5723},
           .orientation = {0, std::numbers::pi / 2, 0},
           .axis = {0, 1, 0},
           .limits = {-2 * std::numbers::pi, 2 * std::numbers::pi, 3.2, 54}},
          {.name = "wrist_2_joint",
           .type = JointType::revolute,
           .parent = "wrist_1_link",
           .child = "wrist_2_link",
           .origin = {0, 0.1149, 0},
           .axis = {0, 0, 1},
           .limits = {-2 * std::numbers::pi, 2 * std::numbers::pi, 3.2, 54}},
          {.name = "wrist_3_joint",
           .type = JointType::revolute,
           .parent = "wrist_2_link",
           .child = "wrist_3_link",
           .origin = {0, 0, 0.1157},
           .axis = {0, 1, 0},
           .limits = {-2 * std::numbers::pi, 2 * std::numbers::pi, 3.2, 54}},
          {.name = "tool0_joint",
           .parent = "wrist_3_link",
           .child = "tool0",
           .origin = {0, 0.0922, 0},
           .orientation = {-std::numbers::pi / 2, 0, 0}},
      })};
};

/// The arm in simulation.
using Ur10Sim = Simulator<Ur10>;

}  // namespace articula
