// SPDX-License-Identifier: Apache-2.0
/// @file An arm with six revolute joints and an adaptive gripper.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/description_parts.hpp"
#include "articula/sim/simulator.hpp"

#include <array>
#include <numbers>
#include <string_view>

namespace articula {

namespace detail {

constexpr std::array<Link, 8> gripper_arm_links() {
  return {{
      upright_link("base_link", 2, 0.04, {.xx = 0.004267, .yy = 0.004267, .zz = 0.0064}),
      upright_link("shoulder_link", 0.85, 0.05, {.xx = 0.001458, .yy = 0.001458, .zz = 0.002025}),
      upright_link("upper_arm_link", 1.2, 0.15, {.xx = 0.00936, .yy = 0.00936, .zz = 0.00072}),
      upright_link("forearm_link", 0.8, 0.12, {.xx = 0.004007, .yy = 0.004007, .zz = 0.000333}),
      upright_link("wrist_roll_link", 0.4, 0.03, {.xx = 0.000203, .yy = 0.000203, .zz = 0.000167}),
      upright_link("wrist_pitch_link", 0.35, 0.025,
                   {.xx = 0.000146, .yy = 0.000146, .zz = 0.000146}),
      upright_link("flange_link", 0.15, 0.01, {.xx = 3.9e-05, .yy = 3.9e-05, .zz = 6.8e-05}),
      upright_link("gripper_base_link", 0.3, 0.03, {.xx = 0.00018, .yy = 0.000213, .zz = 0.000213}),
  }};
}

/// The joints between the base and the gripper, which roll about z or pitch about y.
constexpr std::array<Joint, 7> gripper_arm_joints() {
  const Vector3<double> roll{0, 0, 1}, pitch{0, 1, 0};
  const double half_turn = std::numbers::pi;
  return {{
      revolute_joint("joint_1", "base_link", "shoulder_link", {0, 0, 0.08}, roll,
                     symmetric_limits(half_turn, 2, 60), 0.6),
      revolute_joint("joint_2", "shoulder_link", "upper_arm_link", {0, 0, 0.1}, pitch,
                     symmetric_limits(1.9, 2, 60), 0.6),
      revolute_joint("joint_3", "upper_arm_link", "forearm_link", {0, 0, 0.3}, pitch,
                     symmetric_limits(2.4, 2, 30), 0.3),
      revolute_joint("joint_4", "forearm_link", "wrist_roll_link", {0, 0, 0.24}, roll,
                     symmetric_limits(half_turn, 3, 12), 0.1),
      revolute_joint("joint_5", "wrist_roll_link", "wrist_pitch_link", {0, 0, 0.06}, pitch,
                     symmetric_limits(1.9, 3, 12), 0.1),
      revolute_joint("joint_6", "wrist_pitch_link", "flange_link", {0, 0, 0.05}, roll,
                     symmetric_limits(half_turn, 3, 6), 0.05),
      fixed_joint("gripper_mount", "flange_link", "gripper_base_link", {0, 0, 0.02}),
  }};
}

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

/// The joints of one half of the gripper. Positive positions close it. The fingertip's joint
/// rotates the other way, so that the tip keeps its direction.
/// @param mimicked  the joint that the others mimic
constexpr std::array<Joint, 3> gripper_finger_joints(Side side, const Name& mimicked) {
  const auto finger_joint = [&](std::string_view name, const Name& parent, std::string_view child,
                                double x, double z, double multiplier) {
    const JointLimits closing{.lower = 0, .upper = 0.8, .velocity = 2, .effort = 15};
    const JointLimits opening{.lower = -0.8, .upper = 0, .velocity = 2, .effort = 15};
    Joint joint = revolute_joint(side(name), parent, side(child), {side.sign * x, 0, z},
                                 {0, -side.sign, 0}, multiplier > 0 ? closing : opening, 0.02);
    if (joint.name != mimicked) joint.mimic = {.joint = mimicked, .multiplier = multiplier};
    return joint;
  };
  return {{
      finger_joint("outer_knuckle_joint", "gripper_base_link", "outer_knuckle", 0.0306, 0.055, 1),
      finger_joint("inner_knuckle_joint", "gripper_base_link", "inner_knuckle", 0.0127, 0.061, 1),
      finger_joint("fingertip_joint", side("outer_knuckle"), "fingertip", 0.0315, 0.042, -1),
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
      .links =
          detail::joined(detail::gripper_arm_links(), detail::gripper_finger_links({"left_", 1}),
                         detail::gripper_finger_links({"right_", -1})),
      .joints = detail::joined(
          detail::gripper_arm_joints(),
          detail::gripper_finger_joints({"left_", 1}, "left_outer_knuckle_joint"),
          detail::gripper_finger_joints({"right_", -1}, "left_outer_knuckle_joint"))};
};

/// The arm with its gripper in simulation.
using GripperArmSim = Simulator<GripperArm>;

}  // namespace articula
