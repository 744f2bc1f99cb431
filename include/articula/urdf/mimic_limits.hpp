// SPDX-License-Identifier: Apache-2.0
/// @file Limits of mimics that contradict what they mimic.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/urdf/notices.hpp"

#include <algorithm>
#include <vector>

namespace articula::detail {

/// Some files (grippers whose fingers turn against each other are known for it) give the limits of
/// the leader to those that mimic it -1 times. Taken at their word they leave the leader a single
/// place. Where a mimic alone does that, its limits become what the leader's make of them, and a
/// notice tells.
inline void mend_mimic_limits(std::vector<Joint>& joints, UrdfNotices& notices) {
  for (Joint& joint : joints) {
    const auto leader = std::find_if(joints.begin(), joints.end(), [&](const Joint& other) {
      return !joint.mimic.joint.empty() && other.name == joint.mimic.joint;
    });
    if (leader == joints.end() || joint.type == JointType::continuous) continue;
    const auto place = [&](double position) {
      return joint.mimic.multiplier * position + joint.mimic.offset;
    };
    const double a = place(leader->limits.lower), b = place(leader->limits.upper);
    const double lower = std::min(a, b), upper = std::max(a, b);
    const bool touch = upper == joint.limits.lower || lower == joint.limits.upper;
    if (!touch || !(lower < upper) || !(joint.limits.lower < joint.limits.upper)) continue;
    notices.add_contradiction(joint);
    joint.limits.lower = lower;
    joint.limits.upper = upper;
  }
}

}  // namespace articula::detail
