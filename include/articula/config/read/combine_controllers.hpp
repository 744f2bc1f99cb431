// SPDX-License-Identifier: Apache-2.0
/// @file Combines controllers of one joint each, as ROS 1 has them, to one controller.
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/section.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace articula::detail {

/// True if a section may be a controller of one joint.
[[nodiscard]] inline bool is_single_joint(const ConfigSection& section) {
  return !lists_joints(section.parameters) && section.parameters.find("gains") == nullptr;
}

/// Adds a value of another controller to one, which may lack it.
/// @param what  the value's name in messages
/// @throws FileError if both have the value and it differs
template <class Value>
void combine_values(const std::string& what, Value& value, FilePlace& place, const Value& other,
                    const FilePlace& other_place) {
  if (other_place.file.empty()) return;
  if (place.file.empty()) {
    value = other;
    place = other_place;
  } else if (!(value == other)) {
    throw FileError(other_place,
                    "the " + what + " differs from that in line " + std::to_string(place.line),
                    "the same for controllers that are combined");
  }
}

/// Adds another controller of the same robot and control thread to one.
/// @throws FileError if they have the same joint, another type, or other values of what they share
inline void combine(ControllerConfig& config, ControllerConfig other) {
  const std::string choice = "the name or the type of the controllers that are meant";
  const std::string line = std::to_string(config.place.line);
  if (other.type != config.type) {
    throw FileError(other.place,
                    "its type is '" + shown(other.type) + "', that of the controller in line " +
                        line + " is '" + shown(config.type) + "'",
                    choice);
  }
  combine_values("gravity", config.gravity, config.gravity_place, other.gravity,
                 other.gravity_place);
  combine_values("root", config.chain_root, config.chain_root_place, other.chain_root,
                 other.chain_root_place);
  combine_values("tip", config.chain_tip, config.chain_tip_place, other.chain_tip,
                 other.chain_tip_place);
  combine_values("priority", config.priority, config.priority_place, other.priority,
                 other.priority_place);
  const auto options = [](const ControllerConfig& c) {
    return std::tuple(c.stopped_velocity_tolerance, c.goal_time, c.trajectory.interpolation,
                      c.trajectory.allow_motion_at_end, c.allow_partial_joints,
                      c.allow_integration);
  };
  if (options(config) != options(other)) {
    throw FileError(other.place, "its options of trajectories differ from those in line " + line,
                    "the same for controllers that are combined");
  }
  for (ConfiguredJoint& joint : other.joints) {
    for (const ConfiguredJoint& known : config.joints) {
      if (known.name != joint.name) continue;
      throw FileError(
          joint.place,
          "joint '" + shown(joint.name) + "' is also in line " + std::to_string(known.place.line),
          choice);
    }
    config.joints.push_back(std::move(joint));
  }
  auto& notes = config.notes;
  for (std::string& note : other.notes) {
    if (std::find(notes.begin(), notes.end(), note) == notes.end())
      notes.push_back(std::move(note));
  }
}

}  // namespace articula::detail
