// SPDX-License-Identifier: Apache-2.0
/// @file Joints that <ros2_control> and <transmission> name, and that are otherwise in the robot.
#pragma once

#include "articula/urdf/xml/document.hpp"

#include <string>
#include <vector>

namespace articula::detail {

/// What <ros2_control> and <transmission> say about joints that the joints themselves do not: a
/// line each.
[[nodiscard]] inline std::vector<std::string> name_notices(const UrdfDocument& document) {
  std::vector<std::string> notices;
  const auto exists = [&](const std::string& joint) {
    return document.robot->joints_.contains(joint);
  };
  for (const auto& [joint, limits] : document.command_limits) {
    if (!exists(joint)) notices.push_back("<ros2_control>: joint '" + joint + "' does not exist");
  }
  for (const auto& [joint, leader] : document.command_mimics) {
    if (!exists(joint)) continue;
    const auto& own = document.robot->joints_.at(joint)->mimic;
    if (leader == (own ? own->joint_name : "")) continue;
    notices.push_back("<ros2_control>: joint '" + joint + "' is to mimic " +
                      (leader.empty() ? "nobody" : "'" + leader + "'") +
                      ", but only <mimic> in the joint itself counts");
  }
  for (const UrdfTransmission& transmission : document.transmissions) {
    const std::string where = "transmission '" + transmission.name + "': ";
    const auto add_reduction = [&](const char* kind, const UrdfTransmissionEnd& end) {
      if (end.mechanical_reduction != 0) return;
      notices.push_back(where + kind + " '" + end.name +
                        "': its mechanical reduction is 0, so that it moves nothing");
    };
    for (const UrdfTransmissionEnd& end : transmission.joints) {
      if (!exists(end.name)) notices.push_back(where + "joint '" + end.name + "' does not exist");
      add_reduction("joint", end);
    }
    for (const UrdfTransmissionEnd& end : transmission.actuators) add_reduction("actuator", end);
  }
  return notices;
}

}  // namespace articula::detail
