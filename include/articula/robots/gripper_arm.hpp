// SPDX-License-Identifier: Apache-2.0
/// @file An arm with six revolute joints and an adaptive gripper.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/sides.hpp"
#include "articula/sim/simulator.hpp"

#include <array>
#include <numbers>

namespace articula {

namespace detail {

/// The links of one half of the gripper: the knuckles of a parallelogram and the tip that it
/// carries.
constexpr std::array<Link, 3> gripper_finger_links(Side side) {
  return {{
      {.name = side("outer_knuckle"),
       .mass = 0.02,
       .center_of_mass = {side.sign * 0.015, 0, 0.02},
       .inertia = {.xx = 6e-6, .yy = 7e-6, .zz = 3e-6}},
      {.name = side("inner_knuckle"),
       .mass = 0.03,
       .center_of_mass = {side.sign * 0.015, 0, 0.022},
       .inertia = {.xx = 9e-6, .yy = 1e-5, .zz = 4e-6}},
      {.name = side("fingertip"),
       .mass = 0.045,
       .center_of_mass = {side.sign * -0.004, 0, 0.025},
       .inertia = {.xx = 1.3e-5, .yy = 1.2e-5, .zz = 5e-6}},
  }};
}

/// The joints of one half of the gripper. Positive positions close it. The fingertip's joint rotates
/// the other way, so that the tip keeps its direction.
/// @param mimicked  the joint that the others mimic
constexpr std::array<Joint, 3> gripper_finger_joints(Side side, const Name& mimicked) {
  const Name own = side("outer_knuckle_joint");
  const JointLimits closing{.lower = 0, .upper = 0.8, .velocity = 2, .effort = 15};
  const JointLimits opening{.lower = -0.8, .upper = 0, .velocity = 2, .effort = 15};
  return {{
      {.name = own,
       .type = JointType::revolute,
       .parent = "gripper_base_link",
       .child = side("outer_knuckle"),
       .origin = {side.sign * 0.0306, 0, 0.055},
       .axis = {0, -side.sign, 0},
       .limits = closing,
       .damping = 0.02,
       .mimic = {.joint = own == mimicked ? Name() : mimicked}},
      {.name = side("inner_knuckle_joint"),
       .type = JointType::revolute,
       .parent = "gripper_base_link",
       .child = side("inner_knuckle"),
       .origin = {side.sign * 0.0127, 0, 0.061},
       .axis = {0, -side.sign, 0},
       .limits = closing,
       .damping = 0.02,
       .mimic = {.joint = mimicked}},
      {.name = side("fingertip_joint"),
       .type = JointType::revolute,
       .parent = side("outer_knuckle"),
       .child = side("fingertip"),
       .origin = {side.sign * 0.0315, 0, 0.042},
       .axis = {0, -side.sign, 0},
       .limits = opening,
       .damping = 0.02,
       .mimic = {.joint = mimicked, .multiplier = -1}},
  }};
}

}  // namespace detail

/// An arm with six revolute joints and an adaptive gripper. The seventh joint closes both fingers;
/// five joints mimic it. At zero the arm is upright and the gripper open. Figures: invented for an
/// arm with 0.9 m of reach and bodies that are boxes and cylinders.
struct GripperArm {
  static constexpr RobotDescription description{
      .name = "gripper_arm",
      .gravity = {0, 0, -9.81},
      .links = detail::joined(std::to_array<Link>({
                                  {.name = "base_link",
                                   .mass = 2,
                                   .center_of_mass = {0, 0, 0.04},
                                   .inertia = {.xx = 0.004267, .yy = 0.004267, .zz = 0.0064}},
                                  {.name = "shoulder_link",
                                   .mass = 0.85,
                                   .center_of_mass = {0, 0, 0.05},
                                   .inertia = {.xx = 0.001458, .yy = 0.001458, .zz = 0.002025}},
                                  {.name = "upper_arm_link",
                                   .mass = 1.2,
                                   .center_of_mass = {0, 0, 0.15},
                                   .inertia = {.xx = 0.00936, .yy = 0.00936, .zz = 0.00072}},
                                  {.name = "forearm_link",
                                   .mass = 0.8,
                                   .center_of_mass = {0, 0, 0.12},
                                   .inertia = {.xx = 0.004007, .yy = 0.004007, .zz = 0.000333}},
                                  {.name = "wrist_roll_link",
                                   .mass = 0.4,
                                   .center_of_mass = {0, 0, 0.03},
                                   .inertia = {.xx = 0.000203, .yy = 0.000203, .zz = 0.000167}},
                                  {.name = "wrist_pitch_link",
                                   .mass = 0.35,
                                   .center_of_mass = {0, 0, 0.025},
                                   .inertia = {.xx = 0.000146, .yy = 0.000146, .zz = 0.000146}},
                                  {.name = "flange_link",
                                   .mass = 0.15,
                                   .center_of_mass = {0, 0, 0.01},
                                   .inertia = {.xx = 3.9e-05, .yy = 3.9e-05, .zz = 6.8e-05}},
                                  {.name = "gripper_base_link",
                                   .mass = 0.3,
                                   .center_of_mass = {0, 0, 0.03},
                                   .inertia = {.xx = 0.00018, .yy = 0.000213, .zz = 0.000213}},
                              }),
                              detail::gripper_finger_links({"left_", 1}),
                              detail::gripper_finger_links({"right_", -1})),
      .joints = detail::joined(
          std::to_array<Joint>({
              {.name = "joint_1",
               .type = JointType::revolute,
               .parent = "base_link",
               .child = "shoulder_link",
               .origin = {0, 0, 0.08},
               .axis = {0, 0, 1},
               .limits = {.lower = -std::numbers::pi,
                          .upper = std::numbers::pi,
                          .velocity = 2,
                          .effort = 60},
               .damping = 0.6},
              {.name = "joint_2",
               .type = JointType::revolute,
               .parent = "shoulder_link",
               .child = "upper_arm_link",
               .origin = {0, 0, 0.1},
               .axis = {0, 1, 0},
               .limits = {.lower = -1.9, .upper = 1.9, .velocity = 2, .effort = 60},
               .damping = 0.6},
              {.name = "joint_3",
               .type = JointType::revolute,
               .parent = "upper_arm_link",
               .child = "forearm_link",
               .origin = {0, 0, 0.3},
               .axis = {0, 1, 0},
               .limits = {.lower = -2.4, .upper = 2.4, .velocity = 2, .effort = 30},
               .damping = 0.3},
              {.name = "joint_4",
               .type = JointType::revolute,
               .parent = "forearm_link",
               .child = "wrist_roll_link",
               .origin = {0, 0, 0.24},
               .axis = {0, 0, 1},
               .limits = {.lower = -std::numbers::pi,
                          .upper = std::numbers::pi,
                          .velocity = 3,
                          .effort = 12},
               .damping = 0.1},
              {.name = "joint_5",
               .type = JointType::revolute,
               .parent = "wrist_roll_link",
               .child = "wrist_pitch_link",
               .origin = {0, 0, 0.06},
               .axis = {0, 1, 0},
               .limits = {.lower = -1.9, .upper = 1.9, .velocity = 3, .effort = 12},
               .damping = 0.1},
              {.name = "joint_6",
               .type = JointType::revolute,
               .parent = "wrist_pitch_link",
               .child = "flange_link",
               .origin = {0, 0, 0.05},
               .axis = {0, 0, 1},
               .limits = {.lower = -std::numbers::pi,
                          .upper = std::numbers::pi,
                          .velocity = 3,
                          .effort = 6},
               .damping = 0.05},
              {.name = "gripper_mount",
               .parent = "flange_link",
               .child = "gripper_base_link",
               .origin = {0, 0, 0.02}},
          }),
          detail::gripper_finger_joints({"left_", 1}, "left_outer_knuckle_joint"),
          detail::gripper_finger_joints({"right_", -1}, "left_outer_knuckle_joint"))};
};

/// The arm with its gripper in simulation.
using GripperArmSim = Simulator<GripperArm>;

}  // namespace articula
