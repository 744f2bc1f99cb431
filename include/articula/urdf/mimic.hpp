// SPDX-License-Identifier: Apache-2.0
/// @file Chains of mimic joints, and limits that contradict others: the mimicked joint's, or
/// <limit>.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/urdf/notices.hpp"
#include "articula/urdf/xml/document.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace articula::detail {

/// A joint's position by that of another joint: q = multiplier q_mimicked + offset.
struct ResolvedMimic {
  std::string joint{};  ///< the mimicked joint
  double multiplier = 1;
  double offset = 0;  ///< [rad or m]
};

/// Follows a joint's <mimic>s to a joint that is locked or mimics none. The joints between may be
/// anywhere in the file. The result is the joint itself if it mimics none.
/// @param locked  positions of locked joints [rad or m], by name
/// @throws FileError if the joints mimic each other in a circle
[[nodiscard]] inline ResolvedMimic resolve_mimic(const UrdfDocument& document,
                                                 const std::map<std::string, double>& locked,
                                                 const urdf::Joint& joint) {
  const auto mimics = [&locked](const urdf::Joint& at) {
    const bool moves = at.type == urdf::Joint::REVOLUTE || at.type == urdf::Joint::CONTINUOUS ||
                       at.type == urdf::Joint::PRISMATIC;
    return moves && at.mimic && !locked.contains(at.name);
  };
  const auto& joints = document.robot->joints_;
  ResolvedMimic result{.joint = joint.name};
  const urdf::Joint* at = &joint;
  for (std::size_t step = 0; mimics(*at); ++step) {
    const std::string& mimicked = at->mimic->joint_name;
    if (step > joints.size()) {
      throw FileError(document.file,
                      "joint '" + at->name + "': it mimics itself" +
                          (mimicked == at->name ? "" : " through '" + mimicked + "'"));
    }
    result.offset += result.multiplier * at->mimic->offset;
    result.multiplier *= at->mimic->multiplier;
    result.joint = mimicked;
    const auto next = joints.find(mimicked);
    if (next == joints.end()) break;
    at = next->second.get();
  }
  return result;
}

/// Corrects limits of mimic joints that leave the mimicked joint a single position. Some files of
/// grippers copy the limits of a finger to the finger that mimics it -1 times. Such limits are
/// replaced by those that follow from the mimicked joint's, with a notice.
inline void correct_mimic_limits(std::vector<Joint>& joints, UrdfNotices& notices) {
  for (Joint& joint : joints) {
    const Mimic& mimic = joint.mimic;
    if (mimic.joint.empty() || joint.type == JointType::continuous) continue;
    const auto mimicked = std::ranges::find(joints, mimic.joint, &Joint::name);
    if (mimicked == joints.end()) continue;
    const double a = mimic.multiplier * mimicked->limits.lower + mimic.offset;
    const double b = mimic.multiplier * mimicked->limits.upper + mimic.offset;
    const double lower = std::min(a, b), upper = std::max(a, b);
    const bool touch = upper == joint.limits.lower || lower == joint.limits.upper;
    if (!touch || !(lower < upper) || !(joint.limits.lower < joint.limits.upper)) continue;
    notices.add_ignored_mimic_limits(joint);
    joint.limits.lower = lower;
    joint.limits.upper = upper;
  }
}

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
