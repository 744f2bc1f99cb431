// SPDX-License-Identifier: Apache-2.0
/// @file Groups of a robot's joints.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/core/name.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace articula {

/// A group of a robot's joints.
struct JointGroup {
  Name name{};
  std::vector<Name> joints{};
  int divisor = 1;  ///< its controller is asked in every cycle of this number, >= 1
};

namespace detail {

/// The index of a joint that a group names.
template <Robot R>
[[nodiscard]] int joint_of_group(const R& robot, const JointGroup& group, const Name& joint) {
  try {
    return joint_index(robot, joint.view());
  } catch (const std::invalid_argument& error) {
    refuse({"groups: group '", group.name.view(), "': ", error.what()});
  }
}

}  // namespace detail

/// The place of each joint's group in the list.
/// @param robot   whose joints these are
/// @param groups  of which each joint is in one
/// @throws std::invalid_argument naming the joint that the robot does not have, or that is in two
///         groups or in none
/// @throws std::invalid_argument naming the divisor below 1, or the name that is empty or there
///         twice
/// Real-time: no (allocates).
template <Robot R, std::size_t GroupCount>
[[nodiscard]] JointArray<std::size_t, joint_count<R>> group_of_each_joint(
    const R& robot, const std::array<JointGroup, GroupCount>& groups) {
  JointArray<std::size_t, joint_count<R>> owners;
  owners.fill(GroupCount);
  for (std::size_t g = 0; g < GroupCount; ++g) {
    const JointGroup& group = groups[g];
    if (group.name.empty()) {
      detail::refuse({"groups: group ", g + 1, " has no name; expected ", GroupCount,
                      " groups, one for each controller, each with a name"});
    }
    for (std::size_t other = 0; other < g; ++other) {
      if (groups[other].name == group.name) {
        detail::refuse({"groups: two are named '", group.name.view(), "'"});
      }
    }
    if (group.divisor < 1) {
      detail::refuse(
          {"groups: divisor ", group.divisor, " of group '", group.name.view(), "' is below 1"});
    }
    for (const Name& joint : group.joints) {
      std::size_t& owner = owners[detail::joint_of_group(robot, group, joint)];
      if (owner != GroupCount) {
        detail::refuse({"groups: joint '", joint.view(), "' of group '", group.name.view(),
                        "' is in group '", groups[owner].name.view(), "' already"});
      }
      owner = g;
    }
  }
  const auto names = joint_names(robot);
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (owners[j] == GroupCount) detail::refuse({"groups: joint '", names[j], "' is in no group"});
  }
  return owners;
}

}  // namespace articula
