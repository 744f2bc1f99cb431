// SPDX-License-Identifier: Apache-2.0
/// @file Loads a controller's parameters from a file, independent of the robot. Needs the CMake
/// target articula::config (yaml-cpp).
#pragma once

#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/find_sections.hpp"
#include "articula/config/read/read_controller.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/yaml/source.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

[[nodiscard]] inline bool has_gains(const ConfigSection& section) {
  const auto are_gains = [](const ConfigNode& map) { return map.has_any({"p", "pid", "Kp"}); };
  const ConfigNode& node = section.parameters;
  const ConfigNode* gains = node.find("gains");
  return are_gains(node) || (gains != nullptr && gains->kind != ConfigNode::Kind::scalar) ||
         std::any_of(node.items.begin(), node.items.end(), are_gains);
}

[[nodiscard]] inline bool has_constraints(const ConfigSection& section) {
  return section.parameters.find("constraints") != nullptr;
}

/// A broadcaster has joints, and controls none.
[[nodiscard]] inline bool is_broadcaster(const ConfigSection& section) {
  return section.type.ends_with("Broadcaster") || section.name.ends_with("_broadcaster") ||
         section.type.ends_with("JointStateController");
}

/// True if a section may be a controller of one joint.
[[nodiscard]] inline bool is_single_joint(const ConfigSection& section) {
  return !lists_joints(section.parameters) && section.parameters.find("gains") == nullptr;
}

/// Adds a value of another controller to one, which may lack it.
/// @param what  the value's name
/// @throws FileError if both have the value and it differs
template <class Value>
void combine_values(ControllerConfig& config, const ControllerConfig& other,
                    const std::string& what, Value ControllerConfig::* value) {
  const auto place = other.places.find(what);
  if (place == other.places.end()) return;
  const auto [known, is_new] = config.places.insert(*place);
  if (is_new) {
    config.*value = other.*value;
  } else if (!(config.*value == other.*value)) {
    throw FileError(
        place->second,
        "the " + what + " differs from that in line " + std::to_string(known->second.line),
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
  combine_values(config, other, "gravity", &ControllerConfig::gravity);
  combine_values(config, other, "root", &ControllerConfig::chain_root);
  combine_values(config, other, "tip", &ControllerConfig::chain_tip);
  combine_values(config, other, "priority", &ControllerConfig::priority);
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

/// Of several sections that may be the controller, keeps those that the controller manager lists,
/// and of these those with ros__parameters or a plugin's type. Other programs own the others.
/// @param notes  receives a line on each section that is removed
inline void keep_declared(std::vector<ConfigSection>& sections, std::vector<std::string>& notes) {
  const auto keep = [&](bool ConfigSection::* flag, const std::string& reason) {
    const bool are_parts =
        std::all_of(sections.begin(), sections.end(), [&](const ConfigSection& section) {
          return section.type == sections.front().type && is_single_joint(section);
        });
    const auto has_flag = [&](const ConfigSection& section) { return section.*flag; };
    if (are_parts || std::none_of(sections.begin(), sections.end(), has_flag)) return;
    std::erase_if(sections, [&](const ConfigSection& section) {
      if (has_flag(section)) return false;
      notes.push_back(section.place().text() + "not used, " + reason);
      return true;
    });
  };
  keep(&ConfigSection::is_listed, "the controller_manager does not list it");
  keep(&ConfigSection::is_declared, "it has neither ros__parameters nor the type of a plugin");
}

/// Loads one controller, or combines controllers of one joint each.
/// @param choice  the sections that are meant; broadcasters are never relevant
/// @param robot   the robot with the joints; nullptr: any robot
/// @param signs   allowed signs of gains
[[nodiscard]] inline ControllerConfig load_controller(const ConfigSource& source,
                                                      SectionChoice choice,
                                                      const RobotJoints* robot = nullptr,
                                                      GainSigns signs = GainSigns::not_negative) {
  ConfigSections all = find_sections(source, choice.name);
  choice.is_relevant = [is_relevant = choice.is_relevant](const ConfigSection& section) {
    return !is_broadcaster(section) && is_relevant(section);
  };
  choice.narrow = keep_declared;
  const std::vector<ConfigSection> chosen = chosen_sections(all, choice);
  if (chosen.size() > 1 && !std::all_of(chosen.begin(), chosen.end(), is_single_joint)) {
    std::vector<std::string> names, lines;
    for (const ConfigSection& section : chosen) {
      names.push_back(section.full_name());
      lines.push_back(section.full_name() + " in line " + std::to_string(section.place().line));
    }
    throw FileError(chosen[1].place(), "there are several: " + list_of(lines),
                    one_of_words("", names) + " by name");
  }
  ControllerConfig config = ControllerReader(chosen.front(), robot, signs).take();
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    combine(config, ControllerReader(chosen[k], robot, signs).take());
  }
  config.notes.insert(config.notes.end(), all.notes.begin(), all.notes.end());
  return config;
}

}  // namespace detail

/// Loads a controller's parameters before there is a robot, for example to describe the robot with
/// them:
///
///     const ControllerConfig config = load_controller("pid_plus_gravity.yaml");
///     const auto arm = load_urdf<2>("arm.urdf", {.root = config.chain_root,
///                                                .tip = config.chain_tip,
///                                                .gravity = *config.gravity});
///     PidPlusGravity<Model<2>> controller(arm, pid_gains(arm, config).gains);
///
/// If there is a robot already, call load_pid_gains: it checks the joints, too. Controllers of one
/// joint each, as ROS 1 has them, are combined. Layouts and keys: docs/configuration.md.
/// @param source  a file, or a ConfigSource::text
/// @param name    of the controller, of a namespace, or the type of the controllers; may be empty
///                if the file has one controller
/// @param signs   allowed signs of p, i and d. `any` allows output clamps without 0, too, for
///                ControlToolboxPidLaw
/// @throws FileError with file, line, key and what was expected: for no YAML, no such controller or
///         several, or an unknown or missing key
/// @throws FileError likewise for a wrong type, or a value out of range
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline ControllerConfig load_controller(const ConfigSource& source,
                                                      std::string_view name = {},
                                                      GainSigns signs = GainSigns::not_negative) {
  const auto has_joints = [](const detail::ConfigSection& section) {
    return detail::has_gains(section) || section.parameters.has_any({"constraints", "joints"});
  };
  return detail::load_controller(source, {name, "controller", has_joints}, nullptr, signs);
}

}  // namespace articula
