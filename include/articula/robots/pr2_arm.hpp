// SPDX-License-Identifier: Apache-2.0
/// @file One arm of the PR2.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/description_parts.hpp"

#include <array>
#include <numbers>
#include <string_view>

namespace articula::detail {

/// The links of one arm of the PR2 with its gripper.
/// @param upper_arm  the link that differs between the sides
constexpr auto pr2_arm_links(Side side, const Link& upper_arm) {
  const auto left_finger = [&](std::string_view name) -> Link {
    return {.name = side(name),
            .mass = 0.17126,
            .center_of_mass = {0.03598, 0.0173, -0.00164},
            .inertia = {.xx = 7.756198e-05,
                        .xy = 1.49095e-06,
                        .xz = -9.83385e-06,
                        .yy = 0.00019708305,
                        .yz = -3.06125e-06,
                        .zz = 0.00018105446}};
  };
  const auto right_finger = [&](std::string_view name) -> Link {
    return {.name = side(name),
            .mass = 0.17389,
            .center_of_mass = {0.03576, -0.01736, -0.00095},
            .inertia = {.xx = 7.73841e-05,
                        .xy = -2.09309e-06,
                        .xz = -8.36228e-06,
                        .yy = 0.00019847383,
                        .yz = 2.4611e-06,
                        .zz = 0.00018106988}};
  };
  return std::to_array<Link>({
      {.name = side("shoulder_pan_link"),
       .mass = 25.799322,
       .center_of_mass = {-0.001201, 0.024513, -0.098231},
       .inertia = {.xx = 0.86617914248,
                   .xy = -0.06086507933,
                   .xz = -0.12118061183,
                   .yy = 0.87421714893,
                   .yz = -0.05886609911,
                   .zz = 0.27353821674}},
      {.name = side("shoulder_lift_link"),
       .mass = 2.74988,
       .center_of_mass = {0.02195, -0.02664, -0.03127},
       .inertia = {.xx = 0.02105584615,
                   .xy = 0.00496704022,
                   .xz = -0.00194808955,
                   .yy = 0.02127223737,
                   .yz = 0.0011042549,
                   .zz = 0.01975753814}},
      uniform_link(side("upper_arm_roll_link"), 0.1, 0.01),
      upper_arm,
      {.name = side("elbow_flex_link"),
       .mass = 1.90327,
       .center_of_mass = {0.01014, 0.00032, -0.01211},
       .inertia = {.xx = 0.00346541989,
                   .xy = 4.066825e-05,
                   .xz = 0.00043171614,
                   .yy = 0.00441606455,
                   .yz = -3.968914e-05,
                   .zz = 0.00359156824}},
      uniform_link(side("forearm_roll_link"), 0.1, 0.01),
      uniform_link(side("forearm_cam_frame"), 0.01, 0.001),
      {.name = side("forearm_link"),
       .mass = 2.57968,
       .center_of_mass = {0.18791, -0.00017, -0.00912},
       .inertia = {.xx = 0.00364857222,
                   .xy = 5.215877e-05,
                   .xz = 0.00071534842,
                   .yy = 0.01507736897,
                   .yz = -1.31077e-05,
                   .zz = 0.01659310749}},
      {.name = side("wrist_flex_link"),
       .mass = 0.61402,
       .center_of_mass = {-0.00157, 0, -0.00075},
       .inertia = {.xx = 0.00065165722,
                   .xy = 2.8864e-07,
                   .xz = 3.03477e-06,
                   .yy = 0.00019824443,
                   .yz = -2.2645e-07,
                   .zz = 0.00064450498}},
      uniform_link(side("wrist_roll_link"), 0.1, 0.01),
      {.name = side("gripper_palm_link"),
       .mass = 0.58007,
       .center_of_mass = {0.06623, 0.00053, -0.00119},
       .inertia = {.xx = 0.00035223921,
                   .xy = -1.580476e-05,
                   .xz = -9.175e-07,
                   .yy = 0.00067741312,
                   .yz = -5.9554e-07,
                   .zz = 0.00086563316}},
      left_finger("gripper_l_finger_link"),
      {.name = side("gripper_l_finger_tip_link"),
       .mass = 0.04419,
       .center_of_mass = {0.00423, 0.00284, 0},
       .inertia = {.xx = 8.37047e-06, .xy = 5.83632e-06, .yy = 9.87067e-06, .zz = 1.541768e-05}},
      left_finger("gripper_l_parallel_link"),
      uniform_link(side("gripper_motor_accelerometer_link"), 0.001, 0.001),
      right_finger("gripper_r_finger_link"),
      {.name = side("gripper_r_finger_tip_link"),
       .mass = 0.04419,
       .center_of_mass = {0.00423, -0.00284, 0},
       .inertia = {.xx = 8.37047e-06, .xy = -5.83632e-06, .yy = 9.87067e-06, .zz = 1.541768e-05}},
      right_finger("gripper_r_parallel_link"),
      {.name = side("gripper_tool_frame")},
  });
}

/// The joints of one arm of the PR2. All joints of the gripper mimic that of one finger. In public
/// descriptions the right inner finger has a multiplier of -1, which leaves its limits. Here it
/// mirrors the left one, as on the robot.
/// @param pan          limits of the shoulder's pan joint; only the positions are used
/// @param roll_limits  limits of the upper arm's roll joint; only the positions are used
constexpr auto pr2_arm_joints(Side side, const JointLimits& pan, const JointLimits& roll_limits) {
  const Name mimicked = side("gripper_l_finger_joint");
  const auto finger = [&](std::string_view name, std::string_view parent, std::string_view child,
                          const Vector3<double>& origin, double axis, double damping) {
    Joint joint =
        revolute_joint(side(name), side(parent), side(child), origin, {0, 0, axis},
                       {.lower = 0, .upper = 0.548, .velocity = 0.5, .effort = 1000}, damping);
    if (joint.name != mimicked) joint.mimic.joint = mimicked;
    return joint;
  };
  const auto arm_joint = [&](std::string_view name, std::string_view parent, std::string_view child,
                             double x, const Vector3<double>& axis, const JointLimits& limits,
                             double damping) {
    return revolute_joint(side(name), side(parent), side(child), {x, 0, 0}, axis, limits, damping);
  };
  const auto continuous = [&](std::string_view name, std::string_view parent,
                              std::string_view child, double effort) {
    Joint joint =
        arm_joint(name, parent, child, 0, {1, 0, 0}, {.velocity = 3.6, .effort = effort}, 0.1);
    joint.type = JointType::continuous;
    return joint;
  };
  const auto fixed = [&](std::string_view name, std::string_view parent, std::string_view child,
                         const Vector3<double>& origin = {}) {
    return fixed_joint(side(name), side(parent), side(child), origin);
  };
  const Vector3<double> roll{1, 0, 0}, pitch{0, 1, 0};
  return std::to_array<Joint>({
      revolute_joint(side("shoulder_pan_joint"), "torso_lift_link", side("shoulder_pan_link"),
                     {0, side.sign * 0.188, 0}, {0, 0, 1},
                     {.lower = pan.lower, .upper = pan.upper, .velocity = 2.088, .effort = 30}, 10),
      arm_joint("shoulder_lift_joint", "shoulder_pan_link", "shoulder_lift_link", 0.1, pitch,
                {.lower = -0.5236, .upper = 1.3963, .velocity = 2.082, .effort = 30}, 10),
      arm_joint(
          "upper_arm_roll_joint", "shoulder_lift_link", "upper_arm_roll_link", 0, roll,
          {.lower = roll_limits.lower, .upper = roll_limits.upper, .velocity = 3.27, .effort = 30},
          0.1),
      fixed("upper_arm_joint", "upper_arm_roll_link", "upper_arm_link"),
      arm_joint("elbow_flex_joint", "upper_arm_link", "elbow_flex_link", 0.4, pitch,
                {.lower = -2.3213, .upper = 0, .velocity = 3.3, .effort = 30}, 1),
      continuous("forearm_roll_joint", "elbow_flex_link", "forearm_roll_link", 30),
      {.name = side("forearm_cam_frame_joint"),
       .parent = side("forearm_roll_link"),
       .child = side("forearm_cam_frame"),
       .origin = {0.135, 0, 0.044},
       .orientation = {side.sign * -std::numbers::pi / 2, -0.562868683768, 0}},
      fixed("forearm_joint", "forearm_roll_link", "forearm_link"),
      arm_joint("wrist_flex_joint", "forearm_link", "wrist_flex_link", 0.321, pitch,
                {.lower = -2.094, .upper = 0, .velocity = 3.078, .effort = 10}, 0.1),
      continuous("wrist_roll_joint", "wrist_flex_link", "wrist_roll_link", 10),
      fixed("gripper_palm_joint", "wrist_roll_link", "gripper_palm_link"),
      finger("gripper_l_finger_joint", "gripper_palm_link", "gripper_l_finger_link",
             {0.07691, 0.01, 0}, 1, 0.2),
      finger("gripper_l_finger_tip_joint", "gripper_l_finger_link", "gripper_l_finger_tip_link",
             {0.09137, 0.00495, 0}, -1, 0.01),
      finger("gripper_l_parallel_root_joint", "gripper_palm_link", "gripper_l_parallel_link",
             {0.05891, 0.031, 0}, 1, 0.2),
      fixed("gripper_motor_accelerometer_joint", "gripper_palm_link",
            "gripper_motor_accelerometer_link"),
      finger("gripper_r_finger_joint", "gripper_palm_link", "gripper_r_finger_link",
             {0.07691, -0.01, 0}, -1, 0.2),
      finger("gripper_r_finger_tip_joint", "gripper_r_finger_link", "gripper_r_finger_tip_link",
             {0.09137, -0.00495, 0}, 1, 0.01),
      finger("gripper_r_parallel_root_joint", "gripper_palm_link", "gripper_r_parallel_link",
             {0.05891, -0.031, 0}, -1, 0.2),
      fixed("gripper_tool_joint", "gripper_palm_link", "gripper_tool_frame", {0.18, 0, 0}),
  });
}

}  // namespace articula::detail
