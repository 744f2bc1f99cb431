// SPDX-License-Identifier: Apache-2.0
/// @file Loads a controller's parameters from a file, independent of the robot. Needs the CMake
/// target articula::config (yaml-cpp).
#pragma once

#include "articula/config/read/chosen_sections.hpp"
#include "articula/config/read/combine_controllers.hpp"
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
#include <utility>
#include <vector>

namespace articula {

namespace detail {

[[nodiscard]] inline bool has_gains(const ConfigSection& section) {
  const auto are_gains = [](const ConfigNode& map) { return map.has_any({"p", "pid", "Kp"}); };
  const ConfigNode& node = section.parameters;
  return are_gains(node) || node.find("gains") != nullptr ||
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

/// Of several sections that may be the controller, keeps those that the controller manager lists,
/// and of these those with ros__parameters or a plugin's type. Other programs own the others.
/// @param notes  receives a line on each section that is removed
inline void keep_declared(const std::string& file, std::vector<ConfigSection>& sections,
                          std::vector<std::string>& notes) {
  const auto keep = [&](bool ConfigSection::* flag, const std::string& reason) {
    const bool are_parts =
        std::all_of(sections.begin(), sections.end(), [&](const ConfigSection& section) {
          return section.type == sections.front().type && is_single_joint(section);
        });
    const auto has_flag = [&](const ConfigSection& section) { return section.*flag; };
    if (are_parts || std::none_of(sections.begin(), sections.end(), has_flag)) return;
    std::erase_if(sections, [&](const ConfigSection& section) {
      if (has_flag(section)) return false;
      notes.push_back(section.place(file).text() + "not used, " + reason);
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
  choice.narrow = [&](auto& sections, auto& notes) { keep_declared(all.file, sections, notes); };
  const std::vector<ConfigSection> chosen = chosen_sections(all, choice, all.notes);
  if (chosen.size() > 1 && !std::all_of(chosen.begin(), chosen.end(), is_single_joint)) {
    std::vector<std::string> names, lines;
    for (const ConfigSection& section : chosen) {
      names.push_back(section.full_name());
      lines.push_back(section.full_name() + " in line " + std::to_string(section.line()));
    }
    throw FileError(chosen[1].place(all.file), "there are several: " + list_of(lines),
                    one_of_words("", names) + " by name");
  }
  ControllerConfig config = ControllerReader(all.file, chosen.front(), robot, signs).take();
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    combine(config, ControllerReader(all.file, chosen[k], robot, signs).take());
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
/// @throws FileError with file, line, key and what was expected: no YAML, no such controller or
///         several, an unknown or missing key, a wrong type, a value out of range
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
