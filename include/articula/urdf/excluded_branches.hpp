// SPDX-License-Identifier: Apache-2.0
/// @file The masses that a chain carries in the file, but that are not part of the robot.
#pragma once

#include "articula/urdf/mimic.hpp"
#include "articula/urdf/xml/document.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace articula::detail {

/// The mass of a link and of all its descendants [kg].
[[nodiscard]] inline double mass_from(const urdf::Link& link) {
  double mass = 0;
  for (std::vector<const urdf::Link*> open{&link}; !open.empty();) {
    const urdf::Link& next = *open.back();
    open.pop_back();
    if (next.inertial) mass += next.inertial->mass;
    for (const auto& child : next.child_links) open.push_back(child.get());
  }
  return mass;
}

/// Adds a notice about branches with mass that leave the moving part of a chain. Branches from its
/// resting part do not change the dynamics.
/// @param tip     the chain's last link
/// @param chain   its joints, from the root to the tip
/// @param locked  positions of locked joints [rad or m], by name
inline void add_excluded_branches(const UrdfDocument& document, const std::string& tip,
                                  const std::vector<const urdf::Joint*>& chain,
                                  const std::map<std::string, double>& locked,
                                  UrdfNotices& notices) {
  std::vector<std::string> joints;
  double mass = 0;
  bool moves = false;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    moves = moves || (chain[i]->type != urdf::Joint::FIXED &&
                      !locked.contains(resolve_mimic(document, locked, *chain[i]).joint));
    if (!moves) continue;
    for (const auto& branch : document.robot->links_.at(chain[i]->child_link_name)->child_joints) {
      if (i + 1 < chain.size() && branch.get() == chain[i + 1]) continue;
      const double own = mass_from(*document.robot->links_.at(branch->child_link_name));
      if (!(own > 0)) continue;
      joints.push_back(branch->name);
      mass += own;
    }
  }
  if (joints.empty()) return;
  notices.add("tip '" + tip + "': the chain's joints carry " + rounded_text(mass) +
              " kg that are left out, at joint '" + joints.front() + "'" +
              (joints.size() == 1 ? "" : " and " + std::to_string(joints.size() - 1) + " more") +
              "; to include them, set no tip and lock all other joints");
}

}  // namespace articula::detail
