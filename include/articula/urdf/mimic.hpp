// SPDX-License-Identifier: Apache-2.0
/// @file Chains of mimic joints, and limits of mimic joints that contradict the mimicked joint's.
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

}  // namespace articula::detail
