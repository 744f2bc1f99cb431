// SPDX-License-Identifier: Apache-2.0
/// @file The rules that make a description a robot.
#pragma once

#include <string_view>

namespace articula {

/// What can be wrong with a link, a joint or the tree they form. The names are what a compiler
/// prints.
enum class Rule {
  none,
  name_is_missing,
  name_is_used_twice,
  number_is_not_finite,
  link_has_negative_mass,
  link_has_inertia_but_no_mass,
  inertia_is_not_positive_definite,
  inertia_breaks_the_triangle_inequality,
  parent_link_does_not_exist,
  child_link_does_not_exist,
  link_is_the_child_of_two_joints,
  links_have_more_than_one_root,
  links_form_a_loop,
  robot_has_no_moving_joint,
  fixed_joint_has_limits_or_damping,
  axis_has_length_zero,
  lower_limit_is_above_upper_limit,
  velocity_limit_is_negative,
  effort_limit_is_negative,
  acceleration_limit_is_not_positive,
  jerk_limit_is_not_positive,
  soft_limits_leave_no_position,
  damping_is_negative,
  friction_is_negative,
  reflected_inertia_is_negative,
  joint_moves_no_mass,
  mimicked_joint_does_not_exist,
  mimicked_joint_is_not_free,
  mimics_leave_no_position,
  rotors_are_shared_with_no_free_joint,
  rotors_are_shared_twice,
  shared_inertia_is_too_large,
};

/// True for the rules that a link's inertia breaks in files which are otherwise of use: the
/// equations of motion can be evaluated, though no real body has that inertia.
[[nodiscard]] constexpr bool concerns_inertia(Rule rule) noexcept {
  return rule == Rule::link_has_inertia_but_no_mass ||
         rule == Rule::inertia_is_not_positive_definite ||
         rule == Rule::inertia_breaks_the_triangle_inequality;
}

/// True for the rules that need masses: those of links, and that every joint moves some. A kinematic
/// robot may break them.
[[nodiscard]] constexpr bool concerns_mass(Rule rule) noexcept {
  return concerns_inertia(rule) || rule == Rule::link_has_negative_mass ||
         rule == Rule::joint_moves_no_mass;
}

/// The broken rule in words, for messages at run time.
[[nodiscard]] constexpr std::string_view to_string(Rule rule) noexcept {
  switch (rule) {
    case Rule::none:
      return "no fault";
    case Rule::name_is_missing:
      return "the name is missing";
    case Rule::name_is_used_twice:
      return "the name is used twice";
    case Rule::number_is_not_finite:
      return "a number is NaN, infinite or too large (more than 1e50, or an angle of more than "
             "1e9 rad)";
    case Rule::link_has_negative_mass:
      return "the mass is negative";
    case Rule::link_has_inertia_but_no_mass:
      return "the link has inertia but no mass";
    case Rule::inertia_is_not_positive_definite:
      return "the inertia is not positive definite";
    case Rule::inertia_breaks_the_triangle_inequality:
      return "the inertia breaks the triangle inequality";
    case Rule::parent_link_does_not_exist:
      return "the parent link does not exist";
    case Rule::child_link_does_not_exist:
      return "the child link does not exist";
    case Rule::link_is_the_child_of_two_joints:
      return "the link is the child of two joints";
    case Rule::links_have_more_than_one_root:
      return "the link hangs on no joint, and another link is the root";
    case Rule::links_form_a_loop:
      return "the link is part of a loop";
    case Rule::robot_has_no_moving_joint:
      return "no joint moves";
    case Rule::fixed_joint_has_limits_or_damping:
      return "the joint is fixed, and has limits, damping, friction or a drive; its type may be "
             "missing";
    case Rule::axis_has_length_zero:
      return "the axis has length 0";
    case Rule::lower_limit_is_above_upper_limit:
      return "the lower limit is above the upper limit";
    case Rule::velocity_limit_is_negative:
      return "the velocity limit is negative";
    case Rule::effort_limit_is_negative:
      return "the effort limit is negative";
    case Rule::acceleration_limit_is_not_positive:
      return "the acceleration limit is not positive";
    case Rule::jerk_limit_is_not_positive:
      return "the jerk limit is not positive";
    case Rule::soft_limits_leave_no_position:
      return "the soft limits leave no position within the limits, or their rate is not positive";
    case Rule::damping_is_negative:
      return "the damping is negative";
    case Rule::friction_is_negative:
      return "the friction is negative";
    case Rule::reflected_inertia_is_negative:
      return "the reflected inertia is negative";
    case Rule::joint_moves_no_mass:
      return "the joint moves no link that has mass";
    case Rule::mimicked_joint_does_not_exist:
      return "the joint that is to be mimicked does not exist";
    case Rule::mimicked_joint_is_not_free:
      return "the joint that is to be mimicked is fixed or a mimic itself";
    case Rule::mimics_leave_no_position:
      return "the limits of the joint and of those that mimic it have nothing in common";
    case Rule::rotors_are_shared_with_no_free_joint:
      return "rotors are shared between joints of which one is fixed, a mimic, missing or the same";
    case Rule::rotors_are_shared_twice:
      return "the joint shares rotors with more than one other, or both joints name them";
    case Rule::shared_inertia_is_too_large:
      return "the shared inertia is larger than those of the two joints' drives allow";
  }
  return "unknown rule";
}

}  // namespace articula
