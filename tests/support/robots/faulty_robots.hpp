// SPDX-License-Identifier: Apache-2.0
/// @file For every rule of model/rule.hpp a description that breaks it first.
#pragma once

#include <articula/model/description.hpp>
#include <articula/model/rule.hpp>

#include <array>

namespace support {

/// A double pendulum: stand -pivot-> rod -knee-> bob. Its numbers are plain so that one change
/// breaks one rule.
inline constexpr articula::RobotDescription double_pendulum{
    .name = "swing",
    .gravity = {0, 0, -9.81},
    .links = std::to_array<articula::Link>({
        {.name = "stand"},
        {.name = "rod",
         .mass = 2,
         .center_of_mass = {0, 0, -0.5},
         .inertia = {.xx = 0.2, .yy = 0.2, .zz = 0.01}},
        {.name = "bob", .mass = 1, .inertia = {.xx = 0.01, .yy = 0.01, .zz = 0.01}},
    }),
    .joints = std::to_array<articula::Joint>({
        {.name = "pivot",
         .type = articula::JointType::revolute,
         .parent = "stand",
         .child = "rod",
         .axis = {0, 1, 0}},
        {.name = "knee",
         .type = articula::JointType::continuous,
         .parent = "rod",
         .child = "bob",
         .origin = {0, 0, -1},
         .axis = {0, 1, 0}},
    })};

/// The double pendulum with a link that hangs on nothing.
inline constexpr articula::RobotDescription pendulum_and_table{
    .name = double_pendulum.name,
    .gravity = double_pendulum.gravity,
    .links = std::to_array<articula::Link>({double_pendulum.links[0],
                                            double_pendulum.links[1],
                                            double_pendulum.links[2],
                                            {.name = "table"}}),
    .joints = double_pendulum.joints};

/// The link, joint or robot at fault in robot_with_fault<rule>().
[[nodiscard]] constexpr articula::Name element_at_fault(articula::Rule rule) {
  using articula::Rule;
  switch (rule) {
    case Rule::none:
    case Rule::name_is_missing:
      return "";
    case Rule::number_is_not_finite:
    case Rule::link_has_negative_mass:
    case Rule::link_has_inertia_but_no_mass:
    case Rule::inertia_is_not_positive_definite:
    case Rule::inertia_breaks_the_triangle_inequality:
    case Rule::link_is_the_child_of_two_joints:
    case Rule::links_form_a_loop:
      return "rod";
    case Rule::name_is_used_twice:
    case Rule::mimics_leave_no_position:
    case Rule::rotors_are_shared_twice:
      return "pivot";
    case Rule::links_have_more_than_one_root:
      return "table";
    case Rule::robot_has_no_moving_joint:
      return "swing";
    case Rule::parent_link_does_not_exist:
    case Rule::child_link_does_not_exist:
    case Rule::fixed_joint_has_limits_or_damping:
    case Rule::axis_has_length_zero:
    case Rule::lower_limit_is_above_upper_limit:
    case Rule::velocity_limit_is_negative:
    case Rule::effort_limit_is_negative:
    case Rule::acceleration_limit_is_not_positive:
    case Rule::jerk_limit_is_not_positive:
    case Rule::soft_limits_leave_no_position:
    case Rule::damping_is_negative:
    case Rule::friction_is_negative:
    case Rule::reflected_inertia_is_negative:
    case Rule::joint_moves_no_mass:
    case Rule::mimicked_joint_does_not_exist:
    case Rule::mimicked_joint_is_not_free:
    case Rule::rotors_are_shared_with_no_free_joint:
    case Rule::shared_inertia_is_too_large:
      return "knee";
  }
  return "a rule without a test";
}

/// The double pendulum with one fault.
template <articula::Rule rule>
[[nodiscard]] constexpr auto robot_with_fault() {
  using articula::JointLimits, articula::JointType, articula::Rule;
  if constexpr (rule == Rule::links_have_more_than_one_root) {
    return pendulum_and_table;
  } else {
    auto robot = double_pendulum;
    auto& [stand, rod, bob] = robot.links;
    auto& [pivot, knee] = robot.joints;
    switch (rule) {
      case Rule::none:
      case Rule::links_have_more_than_one_root:
        break;
      case Rule::name_is_missing:
        knee.name = "";
        break;
      case Rule::name_is_used_twice:
        knee.name = "pivot";
        break;
      case Rule::number_is_not_finite:
        rod.center_of_mass.y = JointLimits::infinity;
        break;
      case Rule::link_has_negative_mass:
        rod.mass = -2;
        break;
      case Rule::link_has_inertia_but_no_mass:
        rod.mass = 0;
        break;
      case Rule::inertia_is_not_positive_definite:
        rod.inertia.xz = 0.1;  // xx zz < xz^2
        break;
      case Rule::inertia_breaks_the_triangle_inequality:
        rod.inertia.zz = 0.5;  // > xx + yy
        break;
      case Rule::parent_link_does_not_exist:
        knee.parent = "leg";
        break;
      case Rule::child_link_does_not_exist:
        knee.child = "leg";
        break;
      case Rule::link_is_the_child_of_two_joints:
        knee.child = "rod";
        knee.parent = "stand";
        break;
      case Rule::links_form_a_loop:
        pivot.parent = "bob";
        break;
      case Rule::robot_has_no_moving_joint:
        pivot.type = knee.type = JointType::fixed;
        break;
      case Rule::fixed_joint_has_limits_or_damping:
        knee.type = JointType::fixed;
        knee.limits.effort = 10;
        break;
      case Rule::axis_has_length_zero:
        knee.axis = {0, 0, 0};
        break;
      case Rule::lower_limit_is_above_upper_limit:
        knee.limits.lower = 1;
        knee.limits.upper = -1;
        break;
      case Rule::velocity_limit_is_negative:
        knee.limits.velocity = -1;
        break;
      case Rule::effort_limit_is_negative:
        knee.limits.effort = -1;
        break;
      case Rule::acceleration_limit_is_not_positive:
        knee.limits.acceleration = 0;
        break;
      case Rule::jerk_limit_is_not_positive:
        knee.limits.jerk = 0;
        break;
      case Rule::soft_limits_leave_no_position:
        knee.limits.upper = 1;
        knee.limits.soft_lower = 2;
        break;
      case Rule::damping_is_negative:
        knee.damping = -0.1;
        break;
      case Rule::friction_is_negative:
        knee.friction = -0.1;
        break;
      case Rule::reflected_inertia_is_negative:
        knee.reflected_inertia = -0.1;
        break;
      case Rule::joint_moves_no_mass:
        bob = {.name = "bob"};
        break;
      case Rule::mimicked_joint_does_not_exist:
        knee.mimic.joint = "hip";
        break;
      case Rule::mimicked_joint_is_not_free:
        knee.mimic.joint = "knee";
        break;
      case Rule::mimics_leave_no_position:
        pivot.limits = {.lower = -2, .upper = -1};
        knee.type = JointType::revolute;
        knee.limits = {.lower = 1, .upper = 2};
        knee.mimic.joint = "pivot";
        break;
      case Rule::rotors_are_shared_with_no_free_joint:
        knee.shared_rotors = {"hip", 0.1};
        break;
      case Rule::rotors_are_shared_twice:
        pivot.reflected_inertia = knee.reflected_inertia = 0.2;
        pivot.shared_rotors = {"knee", 0.1};
        knee.shared_rotors = {"pivot", 0.1};
        break;
      case Rule::shared_inertia_is_too_large:
        pivot.reflected_inertia = knee.reflected_inertia = 0.2;
        knee.shared_rotors = {"pivot", -0.21};
        break;
    }
    return robot;
  }
}

}  // namespace support
