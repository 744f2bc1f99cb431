// SPDX-License-Identifier: Apache-2.0
/// @file Whom a joint mimics in the end.
#pragma once

#include "articula/urdf/xml/document.hpp"

#include <cstddef>
#include <map>
#include <string>

namespace articula::detail {

/// What a joint's position is made of: multiplier times that of another joint, plus offset.
struct Leader {
  std::string joint{};
  double multiplier = 1;
  double offset = 0;  ///< [rad or m]
};

/// What a joint follows at the end of the line: a joint that mimics nobody or is held. Those
/// between may lie anywhere in the file. The joint itself if it mimics nobody.
/// @param held  positions of joints that are held [rad or m]
/// @throws UrdfError if the line leads in a circle
[[nodiscard]] inline Leader leader_of(const UrdfDocument& document,
                                      const std::map<std::string, double>& held,
                                      const urdf::Joint& joint) {
  const auto mimics = [&held](const urdf::Joint& at) {
    const bool moves = at.type == urdf::Joint::REVOLUTE || at.type == urdf::Joint::CONTINUOUS ||
                       at.type == urdf::Joint::PRISMATIC;
    return moves && at.mimic && !held.contains(at.name);
  };
  const auto& joints = document.robot->joints_;
  Leader leader{.joint = joint.name};
  const urdf::Joint* at = &joint;
  for (std::size_t step = 0; mimics(*at); ++step) {
    if (step > joints.size()) {
      const std::string& next = at->mimic->joint_name;
      throw UrdfError(document.file, "joint '" + at->name + "': it mimics itself" +
                                         (next == at->name ? "" : ", by way of '" + next + "'"));
    }
    leader.offset += leader.multiplier * at->mimic->offset;
    leader.multiplier *= at->mimic->multiplier;
    leader.joint = at->mimic->joint_name;
    const auto next = joints.find(leader.joint);
    if (next == joints.end()) break;
    at = next->second.get();
  }
  return leader;
}

}  // namespace articula::detail
