// SPDX-License-Identifier: Apache-2.0
/// @file A robot's description from URDF, as a value that is checked once.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/validation.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/control.hpp"
#include "articula/urdf/xml/transmission.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

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

}  // namespace detail

/// The contents of a UrdfDescription.
struct UrdfContents {
  std::string file{};  ///< its name, for messages
  Name name{};
  Vector3<double> gravity{};  ///< free fall in the root link's frame [m/s^2], 3 x 1
  double right_angle_tolerance = default_right_angle_tolerance;  ///< see UrdfOptions
  std::vector<Link> links{};                                     ///< from the root outwards
  /// From the root outwards, locked ones as fixed; with the limits of <limit>, narrowed by those of
  /// <ros2_control>
  std::vector<Joint> joints{};
  bool allow_unphysical = false;                  ///< see UrdfOptions
  bool kinematic = false;                         ///< see UrdfOptions; then no link has mass
  std::vector<UrdfTransmission> transmissions{};  ///< all of the file
  std::map<std::string, UrdfInitialValues> initial_values{};  ///< by joint, from <ros2_control>
  /// What the user should know, a line each; docs/coming_from_ros.md lists the kinds
  std::vector<std::string> notices{};
};

/// A robot's description from URDF: links, joints, transmissions, initial values and notices. It
/// has passed all checks, so every function takes it as it is:
///
///     const UrdfDescription urdf = read_urdf("arm.urdf");
///     for (const std::string& notice : urdf->notices) std::puts(notice.c_str());
///     const auto arm = load_urdf<6>(urdf);
///     const auto gearing = gearing_of<SimpleTransmission>(urdf, "shoulder_transmission");
///
/// It cannot be changed. To change a figure, copy the contents and check them again:
///
///     UrdfContents contents = *urdf;
///     contents.joints[2].reflected_inertia = 0.2;
///     const auto arm = load_urdf<6>(UrdfDescription(contents));
///
/// load_urdf alone suffices where transmissions, initial values and notices are not needed. Its
/// size is known at run time; for a robot known at compile time, use RobotDescription.
class UrdfDescription {
 public:
  /// @throws FileError with element, reason and figures if the contents break a Rule, or if the
  ///         tolerance for right angles is not within 0 .. 0.1
  explicit UrdfDescription(UrdfContents contents) : contents_(std::move(contents)) {
    const double tolerance = contents_.right_angle_tolerance;
    if (!(tolerance >= 0 && tolerance <= 0.1)) {
      throw FileError(contents_.file, "right_angle_tolerance " + detail::rounded_text(tolerance) +
                                          " is not within 0 .. 0.1");
    }
    const DescriptionFault fault =
        find_fault(contents_.name, contents_.gravity, contents_.links, contents_.joints,
                   contents_.allow_unphysical, contents_.kinematic);
    if (fault.rule == Rule::none) return;
    throw FileError(contents_.file,
                    detail::fault_text(fault, contents_.links, contents_.joints) + advice(fault));
  }

  /// The contents, which end with this description: a loop over them needs one with a name.
  /// Real-time: yes.
  [[nodiscard]] const UrdfContents& operator*() const noexcept { return contents_; }
  [[nodiscard]] const UrdfContents* operator->() const noexcept { return &contents_; }

 private:
  /// The option that accepts a fault.
  [[nodiscard]] std::string advice(const DescriptionFault& fault) const {
    if (fault.rule == Rule::joint_moves_no_mass) {
      return "; to load the robot without masses and dynamics, use load_kinematic_urdf (KINEMATIC "
             "in CMake, or articula run --mock)";
    }
    if (!concerns_inertia(fault.rule)) return "";
    std::string others;  // the option accepts all of a file
    for (const Link& link : contents_.links) {
      if (link.name == fault.element || !concerns_inertia(detail::broken_rule(link))) continue;
      others += (others.empty() ? " and those of '" : ", '") + std::string(link.name) + "'";
    }
    return "; to accept it" + others +
           ", set allow_unphysical (ALLOW_UNPHYSICAL in CMake, --allow-unphysical of articula)";
  }

  UrdfContents contents_;
};

}  // namespace articula
