// SPDX-License-Identifier: Apache-2.0
/// @file Messages about faults of descriptions, with figures.
#pragma once

#include "articula/model/validation.hpp"
#include "articula/text/numbers.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>

namespace articula::detail {

/// A link's mass and the principal moments of its inertia, ascending.
[[nodiscard]] inline std::string principal_moments_text(const Link& link) {
  const Symmetric3<double>& i = link.inertia;
  Eigen::Matrix3d matrix;
  matrix << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz;
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
  return "mass " + rounded_text(link.mass) + " kg, principal moments of inertia " +
         rounded_text(moments[0]) + ", " + rounded_text(moments[1]) + ", " +
         rounded_text(moments[2]) + " kg m^2";
}

/// The figures that break a rule; empty if it needs none.
[[nodiscard]] inline std::string figures(const Link& link, Rule rule) {
  if (rule == Rule::link_has_negative_mass) return rounded_text(link.mass) + " kg";
  return concerns_inertia(rule) ? principal_moments_text(link) : "";
}

/// @copydoc figures(const Link&, Rule)
[[nodiscard]] inline std::string figures(const Joint& joint, Rule rule) {
  const JointLimits& limits = joint.limits;
  std::string range =
      "lower " + rounded_text(limits.lower) + ", upper " + rounded_text(limits.upper);
  const std::initializer_list<std::pair<Rule, double>> numbers = {
      {Rule::velocity_limit_is_negative, limits.velocity},
      {Rule::effort_limit_is_negative, limits.effort},
      {Rule::acceleration_limit_is_not_positive, limits.acceleration},
      {Rule::jerk_limit_is_not_positive, limits.jerk},
      {Rule::damping_is_negative, joint.damping},
      {Rule::friction_is_negative, joint.friction},
      {Rule::reflected_inertia_is_negative, joint.reflected_inertia},
      {Rule::shared_inertia_is_too_large, joint.shared_rotors.inertia}};
  for (const auto& [each, number] : numbers) {
    if (each == rule) return rounded_text(number);
  }
  switch (rule) {
    case Rule::axis_has_length_zero:
      return "0 0 0";
    case Rule::lower_limit_is_above_upper_limit:
      return range;
    case Rule::soft_limits_leave_no_position:
      return "soft_lower " + rounded_text(limits.soft_lower) + ", soft_upper " +
             rounded_text(limits.soft_upper) + ", soft_rate " + rounded_text(limits.soft_rate) +
             ", " + range;
    case Rule::joint_moves_no_mass:
      return "lock it, or give link '" + std::string(joint.child) + "' a mass";
    case Rule::mimicked_joint_does_not_exist:
    case Rule::mimicked_joint_is_not_free:
      return std::string(joint.mimic.joint);
    case Rule::rotors_are_shared_with_no_free_joint:
    case Rule::rotors_are_shared_twice:
      return std::string(joint.shared_rotors.joint);
    default:
      return "";
  }
}

/// A fault in one line: `link 'elbow': the mass is negative (-0.3 kg)`.
[[nodiscard]] inline std::string fault_text(const DescriptionFault& fault,
                                            std::span<const Link> links,
                                            std::span<const Joint> joints) {
  std::string kind = "robot", details;
  if (fault.rule == Rule::robot_has_no_moving_joint)
    links = {}, joints = {};  // a link or joint may have the robot's name
  if (fault.rule == Rule::number_is_not_finite) details = "gravity";  // a robot's only numbers
  const auto joint = std::ranges::find(joints, fault.element, &Joint::name);
  if (joint != joints.end()) {
    kind = "joint";
    details = figures(*joint, fault.rule);
  }
  // A link and a joint may have the same name. The rules of links are checked first.
  const auto link = std::ranges::find(links, fault.element, &Link::name);
  if (link != links.end() && (kind == "robot" || broken_rule(*link) == fault.rule)) {
    kind = "link";
    details = figures(*link, fault.rule);
  }
  return kind + " '" + std::string(fault.element.view()) +
         "': " + std::string(to_string(fault.rule)) + (details.empty() ? "" : " (" + details + ")");
}

}  // namespace articula::detail
