// SPDX-License-Identifier: Apache-2.0
/// @file The rules that a description must obey, and the check of single links and joints.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/model/joint.hpp"
#include "articula/model/link.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace articula {

/// The possible faults of a link, a joint or the tree of all. Compiler errors print these names.
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

/// True for the rules about a link's inertia that `allow_unphysical` waives. No real body has such
/// an inertia, but the equations of motion can be evaluated.
[[nodiscard]] constexpr bool concerns_inertia(Rule rule) noexcept {
  return rule == Rule::link_has_inertia_but_no_mass ||
         rule == Rule::inertia_is_not_positive_definite ||
         rule == Rule::inertia_breaks_the_triangle_inequality;
}

/// True for the rules about mass, which a kinematic robot may break.
[[nodiscard]] constexpr bool concerns_mass(Rule rule) noexcept {
  return concerns_inertia(rule) || rule == Rule::link_has_negative_mass ||
         rule == Rule::joint_moves_no_mass;
}

/// The text of a broken rule, for messages at run time.
[[nodiscard]] constexpr std::string_view to_string(Rule rule) noexcept {
  constexpr auto texts = std::to_array<std::pair<Rule, std::string_view>>({
      {Rule::none, "no fault"},
      {Rule::name_is_missing, "the name is missing"},
      {Rule::name_is_used_twice, "the name is used twice"},
      {Rule::number_is_not_finite,
       "a number is NaN, infinite or too large (more than 1e50, or an angle of more than 1e9 rad)"},
      {Rule::link_has_negative_mass, "the mass is negative"},
      {Rule::link_has_inertia_but_no_mass, "the link has inertia but no mass"},
      {Rule::inertia_is_not_positive_definite, "the inertia is not positive definite"},
      {Rule::inertia_breaks_the_triangle_inequality, "the inertia breaks the triangle inequality"},
      {Rule::parent_link_does_not_exist, "the parent link does not exist"},
      {Rule::child_link_does_not_exist, "the child link does not exist"},
      {Rule::link_is_the_child_of_two_joints, "the link is the child of two joints"},
      {Rule::links_have_more_than_one_root,
       "the link is the child of no joint, but another link is the root"},
      {Rule::links_form_a_loop, "the link is part of a loop"},
      {Rule::robot_has_no_moving_joint, "no joint moves"},
      {Rule::fixed_joint_has_limits_or_damping,
       "the joint is fixed, but has limits, damping, friction or a drive; its type may be missing"},
      {Rule::axis_has_length_zero, "the axis has length 0"},
      {Rule::lower_limit_is_above_upper_limit, "the lower limit is above the upper limit"},
      {Rule::velocity_limit_is_negative, "the velocity limit is negative"},
      {Rule::effort_limit_is_negative, "the effort limit is negative"},
      {Rule::acceleration_limit_is_not_positive, "the acceleration limit is not positive"},
      {Rule::jerk_limit_is_not_positive, "the jerk limit is not positive"},
      {Rule::soft_limits_leave_no_position,
       "the soft limits leave no position within the limits, or their rate is not positive"},
      {Rule::damping_is_negative, "the damping is negative"},
      {Rule::friction_is_negative, "the friction is negative"},
      {Rule::reflected_inertia_is_negative, "the reflected inertia is negative"},
      {Rule::joint_moves_no_mass, "the joint moves no link that has mass"},
      {Rule::mimicked_joint_does_not_exist, "the mimicked joint does not exist"},
      {Rule::mimicked_joint_is_not_free, "the mimicked joint is fixed or mimics another joint"},
      {Rule::mimics_leave_no_position,
       "the limits of the joint and of those that mimic it have no position in common"},
      {Rule::rotors_are_shared_with_no_free_joint,
       "rotors are shared with a joint that is missing, fixed, a mimic or the joint itself"},
      {Rule::rotors_are_shared_twice,
       "the joint shares rotors with more than one other, or both joints name each other"},
      {Rule::shared_inertia_is_too_large,
       "the shared inertia c is too large: c^2 must not exceed the product of the two reflected "
       "inertias"},
  });
  for (const auto& [each, text] : texts) {
    if (each == rule) return text;
  }
  return "unknown rule";
}

namespace detail {

constexpr bool all_finite(const Vector3<double>& a) {
  return is_finite(a.x) && is_finite(a.y) && is_finite(a.z);
}

/// Numbers so small that products of masses, lengths and accelerations cannot overflow.
constexpr bool are_usable(auto... numbers) {
  constexpr double most = 1e50;
  return ((magnitude(numbers) <= most) && ...);
}
constexpr bool are_usable(const Vector3<double>& a) { return are_usable(a.x, a.y, a.z); }
constexpr bool are_usable(const Symmetric3<double>& m) {
  return are_usable(m.xx, m.xy, m.xz, m.yy, m.yz, m.zz);
}

/// Angles that sine_cosine accepts.
constexpr bool are_angles(const Vector3<double>& rpy) {
  const auto is_angle = [](double x) { return magnitude(x) <= constant_math::largest_angle; };
  return is_angle(rpy.x) && is_angle(rpy.y) && is_angle(rpy.z);
}

/// Positive definite: all pivots of the elimination are positive.
constexpr bool is_positive_definite(const Symmetric3<double>& m) {
  if (!(m.xx > 0)) return false;
  const double yy = m.yy - m.xy * m.xy / m.xx, yz = m.yz - m.xy * m.xz / m.xx;
  if (!(yy > 0)) return false;
  return m.zz - m.xz * m.xz / m.xx - yz * yz / yy > 0;
}

/// The principal moments A, B, C of a real mass distribution obey A + B >= C in every order.
/// Equivalently, the second moments of mass, (trace/2) 1 - I, are positive semidefinite
/// [Wensing, Kim, Slotine 2018, section III]. A flat plate has A + B = C, so the tolerance for
/// rounding is 1e-12 of the trace, some thousand units in the last place.
constexpr bool obeys_triangle_inequality(const Symmetric3<double>& i) {
  const double trace = i.xx + i.yy + i.zz, half = trace / 2 + 1e-12 * trace;
  return is_positive_definite({half - i.xx, -i.xy, -i.xz, half - i.yy, -i.yz, half - i.zz});
}

/// The first rule that a link breaks.
constexpr Rule broken_rule(const Link& link) {
  if (link.name.empty()) return Rule::name_is_missing;
  if (!are_usable(link.mass) || !are_usable(link.center_of_mass) || !are_usable(link.inertia) ||
      !are_angles(link.inertia_orientation)) {
    return Rule::number_is_not_finite;
  }
  if (link.mass < 0) return Rule::link_has_negative_mass;
  if (link.mass == 0) {
    return link.inertia == Symmetric3<double>{} ? Rule::none : Rule::link_has_inertia_but_no_mass;
  }
  if (!is_positive_definite(link.inertia)) return Rule::inertia_is_not_positive_definite;
  if (!obeys_triangle_inequality(link.inertia)) return Rule::inertia_breaks_the_triangle_inequality;
  return Rule::none;
}

/// The first rule that a joint breaks by itself.
constexpr Rule broken_rule(const Joint& joint) {
  const JointLimits& limits = joint.limits;
  if (joint.name.empty()) return Rule::name_is_missing;
  if (!are_usable(joint.origin) || !are_angles(joint.orientation) || !all_finite(joint.axis) ||
      !are_usable(joint.damping, joint.friction, joint.reflected_inertia, joint.mimic.multiplier,
                  joint.mimic.offset, joint.shared_rotors.inertia)) {
    return Rule::number_is_not_finite;
  }
  if (joint.type == JointType::fixed) {
    const bool is_bare = limits == JointLimits{} && joint.damping == 0 && joint.friction == 0 &&
                         joint.reflected_inertia == 0;
    return is_bare ? Rule::none : Rule::fixed_joint_has_limits_or_damping;
  }
  if (joint.axis == Vector3<double>{}) return Rule::axis_has_length_zero;
  if (!(limits.lower <= limits.upper)) return Rule::lower_limit_is_above_upper_limit;
  if (limits.lower == JointLimits::infinity || limits.upper == -JointLimits::infinity) {
    return Rule::number_is_not_finite;
  }
  if (!(limits.velocity >= 0)) return Rule::velocity_limit_is_negative;
  if (!(limits.effort >= 0)) return Rule::effort_limit_is_negative;
  if (!(limits.acceleration > 0)) return Rule::acceleration_limit_is_not_positive;
  if (!(limits.jerk > 0)) return Rule::jerk_limit_is_not_positive;
  if (!(limits.soft_lower <= limits.soft_upper && limits.soft_lower <= limits.upper &&
        limits.soft_upper >= limits.lower && limits.soft_rate > 0)) {
    return Rule::soft_limits_leave_no_position;
  }
  if (joint.damping < 0) return Rule::damping_is_negative;
  if (joint.friction < 0) return Rule::friction_is_negative;
  if (joint.reflected_inertia < 0) return Rule::reflected_inertia_is_negative;
  return Rule::none;
}

}  // namespace detail

}  // namespace articula
