// SPDX-License-Identifier: Apache-2.0
/// @file What is wrong with a description, in words and figures.
#pragma once

#include "articula/model/validation.hpp"
#include "articula/text/numbers.hpp"

#include <Eigen/Eigenvalues>

#include <span>
#include <string>

namespace articula::detail {

/// The principal moments of a link's inertia, ascending.
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

/// The figures that break a rule; empty if the rule says it all.
[[nodiscard]] inline std::string figures(const Link& link, Rule rule) {
  if (rule == Rule::link_has_negative_mass) return rounded_text(link.mass) + " kg";
  return concerns_inertia(rule) ? principal_moments_text(link) : "";
}

/// @copydoc figures(const Link&, Rule)
[[nodiscard]] inline std::string figures(const Joint& joint, Rule rule) {
  const JointLimits& limits = joint.limits;
  switch (rule) {
    case Rule::axis_has_length_zero:
      return rounded_text(joint.axis.x) + " " + rounded_text(joint.axis.y) + " " +
             rounded_text(joint.axis.z);
    case Rule::lower_limit_is_above_upper_limit:
      return "lower " + rounded_text(limits.lower) + ", upper " + rounded_text(limits.upper);
    case Rule::velocity_limit_is_negative:
      return rounded_text(limits.velocity);
    case Rule::effort_limit_is_negative:
      return rounded_text(limits.effort);
    case Rule::acceleration_limit_is_not_positive:
      return rounded_text(limits.acceleration);
    case Rule::jerk_limit_is_not_positive:
      return rounded_text(limits.jerk);
    case Rule::soft_limits_leave_no_position:
      return "soft_lower " + rounded_text(limits.soft_lower) + ", soft_upper " +
             rounded_text(limits.soft_upper) + ", soft_rate " + rounded_text(limits.soft_rate) +
             ", lower " + rounded_text(limits.lower) + ", upper " + rounded_text(limits.upper);
    case Rule::damping_is_negative:
      return rounded_text(joint.damping);
    case Rule::friction_is_negative:
      return rounded_text(joint.friction);
    case Rule::reflected_inertia_is_negative:
      return rounded_text(joint.reflected_inertia);
    case Rule::joint_moves_no_mass:
      return "lock it, or give link '" + std::string(joint.child.view()) + "' a mass";
    case Rule::mimicked_joint_does_not_exist:
    case Rule::mimicked_joint_is_not_free:
      return std::string(joint.mimic.joint.view());
    case Rule::rotors_are_shared_with_no_free_joint:
    case Rule::rotors_are_shared_twice:
      return std::string(joint.shared_rotors.joint.view());
    case Rule::shared_inertia_is_too_large:
      return rounded_text(joint.shared_rotors.inertia);
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
    links = {}, joints = {};                                          // it has its own name
  if (fault.rule == Rule::number_is_not_finite) details = "gravity";  // a robot's only numbers
  if (const int i = index_of(joints, fault.element); i >= 0) {
    kind = "joint";
    details = figures(joints[static_cast<std::size_t>(i)], fault.rule);
  }
  // Links and joints may share a name. The rules of links come first, so a link at fault wins.
  const int i = index_of(links, fault.element);
  if (i >= 0 &&
      (kind == "robot" || broken_rule(links[static_cast<std::size_t>(i)]) == fault.rule)) {
    kind = "link";
    details = figures(links[static_cast<std::size_t>(i)], fault.rule);
  }
  return kind + " '" + std::string(fault.element.view()) +
         "': " + std::string(to_string(fault.rule)) + (details.empty() ? "" : " (" + details + ")");
}

}  // namespace articula::detail
