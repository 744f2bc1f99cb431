// SPDX-License-Identifier: Apache-2.0
/// @file Which controllers act on which joints.
#pragma once

#include "files/controllers_file.hpp"

#include <articula/urdf/description.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace terminal {

/// Joints that the same controllers act on.
struct PlannedGroup {
  std::vector<std::string> joints{};
  std::vector<std::size_t> controllers{};  ///< places in ControllersPlan::controllers; may be empty
};

/// The groups of a robot's joints. The first has the file's first controller. Joints that no
/// controller names are the last group, which has no controllers.
/// @throws articula::FileError if a controller names a joint that the robot does not have; Refusal
///         if two controllers have some of their joints in common
[[nodiscard]] std::vector<PlannedGroup> joint_groups(const articula::UrdfDescription& robot,
                                                     const ControllersPlan& plan);

}  // namespace terminal
