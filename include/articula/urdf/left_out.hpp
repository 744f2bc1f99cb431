// SPDX-License-Identifier: Apache-2.0
/// @file What a chain carries in the file, but not in the robot.
#pragma once

#include "articula/urdf/leader.hpp"
#include "articula/urdf/xml/document.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace articula::detail {

/// Branches off the moving part of a chain, with what hangs on them.
struct LeftOut {
  std::vector<std::string> joints{};  ///< by which they hang on the chain
  double mass = 0;                    ///< [kg]
};

/// The mass of a link and of all beyond it [kg].
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

/// What a chain leaves out that its joints would have to move. Branches off its base are not among
/// it: they change nothing.
/// @param chain  its joints, from the root to the tip
/// @param held   where joints are held [rad or m], by name
[[nodiscard]] inline LeftOut left_out_by(const UrdfDocument& document,
                                         const std::vector<const urdf::Joint*>& chain,
                                         const std::map<std::string, double>& held) {
  LeftOut result;
  bool moves = false;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    moves = moves || (chain[i]->type != urdf::Joint::FIXED &&
                      !held.contains(leader_of(document, held, *chain[i]).joint));
    if (!moves) continue;
    for (const auto& branch : document.robot->links_.at(chain[i]->child_link_name)->child_joints) {
      if (i + 1 < chain.size() && branch.get() == chain[i + 1]) continue;
      const double mass = mass_from(*document.robot->links_.at(branch->child_link_name));
      if (!(mass > 0)) continue;
      result.joints.push_back(branch->name);
      result.mass += mass;
    }
  }
  return result;
}

}  // namespace articula::detail
