// SPDX-License-Identifier: Apache-2.0
/// @file A robot's description from URDF, as a value that is checked once.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/validation.hpp"
#include "articula/text/file_error.hpp"
#include "articula/urdf/fault_text.hpp"
#include "articula/urdf/xml/control.hpp"
#include "articula/urdf/xml/transmission.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace articula {

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

  /// The contents. Real-time: yes.
  [[nodiscard]] const UrdfContents& operator*() const noexcept { return contents_; }
  [[nodiscard]] const UrdfContents* operator->() const noexcept { return &contents_; }

 private:
  /// The option that accepts a fault.
  [[nodiscard]] std::string advice(const DescriptionFault& fault) const {
    if (fault.rule == Rule::joint_moves_no_mass) {
      return "; to load the robot without masses and dynamics, use load_kinematic_urdf (KINEMATIC "
             "in CMake)";
    }
    if (!concerns_inertia(fault.rule)) return "";
    std::string others;  // the option accepts all of a file
    for (const Link& link : contents_.links) {
      if (link.name == fault.element || !concerns_inertia(detail::broken_rule(link))) continue;
      others += (others.empty() ? " and those of '" : ", '") + std::string(link.name) + "'";
    }
    return "; to accept it" + others + ", set allow_unphysical (ALLOW_UNPHYSICAL in CMake)";
  }

  UrdfContents contents_;
};

}  // namespace articula
