// SPDX-License-Identifier: Apache-2.0
/// @file Check of limits in <ros2_control> that allow a joint no velocity, effort or position.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/urdf/notices.hpp"
#include "articula/urdf/xml/document.hpp"

#include <string>

namespace articula::detail {

/// Refuses limits in <ros2_control> that allow a joint no velocity, effort or position. Where such
/// limits are not used, a notice reports them: limits of a mimic joint, and efforts of a kinematic
/// robot.
/// @param kinematic  whether efforts are not used
/// @param mimicked   the joint that this one mimics; empty: none
/// @param limits     of the joint; positions of a mimic joint become those of <limit> where
///                   <ros2_control> leaves it none
/// @throws FileError if the limits are used
inline void check_command_limits(const UrdfDocument& document, bool kinematic,
                                 const urdf::Joint& joint, const std::string& mimicked,
                                 JointLimits& limits, UrdfNotices& notices) {
  const std::string name = "joint '" + joint.name + "': ", mimics = "it mimics '" + mimicked + "'";
  const auto [first, last] = document.control.contradictions.equal_range(joint.name);
  for (auto at = first; at != last; ++at) {
    const LimitContradiction& found = at->second;
    const std::string owner = "<ros2_control>: " + name + found.kind + ": ";
    if (mimicked.empty() && !(kinematic && found.kind != "velocity")) {
      throw FileError(document.file, owner + found.reason);
    }
    notices.add(owner + "its limits (" + found.bounds +
                ") are ignored: " + (mimicked.empty() ? "the robot is kinematic" : mimics));
  }
  const auto command = document.control.limits.find(joint.name);
  if (command == document.control.limits.end() || limits.lower <= limits.upper || !joint.limits ||
      joint.limits->lower > joint.limits->upper) {
    return;  // <limit> alone may be at fault: find_fault reports it
  }
  const auto range = [](double lower, double upper) {
    return number_text(lower) + " .. " + number_text(upper);
  };
  const std::string text =
      name + "its limits, " + range(command->second.lower, command->second.upper) +
      " in <ros2_control> and " + range(joint.limits->lower, joint.limits->upper) +
      " in <limit>, leave it no position";
  if (mimicked.empty()) throw FileError(document.file, text);
  notices.add(text + "; " + mimics + ", so those of <limit> are used");
  limits.lower = joint.limits->lower;
  limits.upper = joint.limits->upper;
}

}  // namespace articula::detail
