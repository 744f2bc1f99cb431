// SPDX-License-Identifier: Apache-2.0
/// @file What a user should know of the files of a robot, and is no reason to refuse them.
#pragma once

#include "files/joint_groups.hpp"
#include "files/robot_file.hpp"

#include <string>
#include <vector>

namespace terminal {

/// Prints on standard error what the files have that is not used, and joints without a controller.
/// @param file  of the robot
void print_notes(const ControllersPlan& controllers, const std::vector<PlannedGroup>& groups,
                 const articula::UrdfDescription& robot, const std::string& file);

}  // namespace terminal
