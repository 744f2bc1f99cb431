// SPDX-License-Identifier: Apache-2.0
/// @file Reads a controller's parameters from a file, whichever robot it is for. Needs the CMake
/// target articula::config (yaml-cpp).
#pragma once

#include "articula/config/read/chosen_sections.hpp"
#include "articula/config/read/controller_config.hpp"
#include "articula/config/read/find_sections.hpp"
#include "articula/config/read/read_controller.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/yaml/source.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

[[nodiscard]] inline bool has_gains(const ConfigSection& section) {
  const auto are_gains = [](const ConfigNode& map) {
    return map.find("p") != nullptr || map.find("pid") != nullptr || map.find("Kp") != nullptr;
  };
  const ConfigNode& node = section.parameters;
  return are_gains(node) || node.find("gains") != nullptr ||
         std::any_of(node.items.begin(), node.items.end(), are_gains);
}

[[nodiscard]] inline bool has_constraints(const ConfigSection& section) {
  return section.parameters.find("constraints") != nullptr;
}

/// A broadcaster has joints as well, and controls none.
[[nodiscard]] inline bool is_broadcaster(const ConfigSection& section) {
  return section.type.ends_with("Broadcaster") || section.name.ends_with("_broadcaster") ||
         section.type.ends_with("JointStateController");
}

[[nodiscard]] inline bool has_joints(const ConfigSection& section) {
  return has_gains(section) || has_constraints(section) ||
         section.parameters.find("joints") != nullptr;
}

/// Adds what another controller says to a configuration. There is one robot and one control thread:
/// what both say about them must be the same.
inline void put_together(ControllerConfig& config, ControllerConfig more) {
  const auto refuse = [&](const FilePlace& place, const std::string& what,
                          const std::string& expected) { throw FileError(place, what, expected); };
  const std::string several = "the name or the type of the controllers that are meant";
  if (more.type != config.type) {
    refuse(more.place,
           "its type is '" + shown(more.type) + "', that of the controller in line " +
               std::to_string(config.place.line) + " is '" + shown(config.type) + "'",
           several);
  }
  const auto same = [&](const std::string& what, auto& first, FilePlace& first_place,
                        const auto& second, const FilePlace& second_place) {
    if (second_place.file.empty()) return;
    if (first_place.file.empty()) {
      first = second;
      first_place = second_place;
    } else if (!(first == second)) {
      refuse(second_place,
             "the " + what + " is another one in line " + std::to_string(first_place.line),
             "the same for controllers that are put together");
    }
  };
  same("gravity", config.gravity, config.gravity_place, more.gravity, more.gravity_place);
  same("root", config.chain_root, config.chain_root_place, more.chain_root, more.chain_root_place);
  same("tip", config.chain_tip, config.chain_tip_place, more.chain_tip, more.chain_tip_place);
  same("priority", config.priority, config.priority_place, more.priority, more.priority_place);
  const auto options = [](const ControllerConfig& c) {
    return std::tuple(c.stopped_velocity_tolerance, c.goal_time, c.trajectory.interpolation,
                      c.trajectory.allow_motion_at_end, c.allow_partial_joints,
                      c.allow_integration);
  };
  if (options(config) != options(more)) {
    refuse(more.place,
           "its options of trajectories are not those in line " + std::to_string(config.place.line),
           "the same for controllers that are put together");
  }
  for (ConfiguredJoint& joint : more.joints) {
    for (const ConfiguredJoint& known : config.joints) {
      if (known.name != joint.name) continue;
      refuse(
          joint.place,
          "joint '" + shown(joint.name) + "' is also in line " + std::to_string(known.place.line),
          several);
    }
    config.joints.push_back(std::move(joint));
  }
  for (std::string& note : more.notes) {
    const auto& notes = config.notes;
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) {
      config.notes.push_back(std::move(note));
    }
  }
}

/// True if sections are controllers of one joint each, of one type: they are put together.
[[nodiscard]] inline bool are_single_joints(const std::vector<ConfigSection>& sections) {
  return std::all_of(sections.begin(), sections.end(), [&](const ConfigSection& section) {
    const ConfigNode& node = section.parameters;
    return section.type == sections.front().type && node.find("joints") == nullptr &&
           node.find("dof_names") == nullptr && node.find("joint_names") == nullptr &&
           node.find("gains") == nullptr;
  });
}

/// Where several sections may be the controller: those that the controller manager lists, and of
/// these those with ros__parameters or a plugin's type. The others belong to other programs.
/// @param notes  receives a line on each other one
inline void keep_declared(const std::string& file, std::vector<ConfigSection>& sections,
                          std::vector<std::string>& notes) {
  const auto keep = [&](bool ConfigSection::* sign, const std::string& reason) {
    if (are_single_joints(sections)) return;
    const auto has_sign = [&](const ConfigSection& section) { return section.*sign; };
    if (std::none_of(sections.begin(), sections.end(), has_sign)) return;
    std::erase_if(sections, [&](const ConfigSection& section) {
      if (has_sign(section)) return false;
      notes.push_back(file + ":" + std::to_string(section.line()) + ": " + section.path +
                      ": not used, " + reason);
      return true;
    });
  };
  keep(&ConfigSection::is_listed, "the controller_manager does not list it");
  keep(&ConfigSection::is_declared, "it has neither ros__parameters nor the type of a plugin");
}

/// One controller, or single-joint controllers as if they were one.
/// @param relevant  see chosen_sections
/// @param what      is looked for, for messages
/// @param robot     whose joints they are; nullptr: of any robot
/// @param signs     which its gains may have
[[nodiscard]] inline ControllerConfig load_controller(
    const ConfigSource& source, std::string_view name,
    const std::function<bool(const ConfigSection&)>& relevant, const std::string& what,
    const RobotJoints* robot = nullptr, GainSigns signs = GainSigns::not_negative) {
  ConfigSections all = find_sections(source, name);
  const auto controls = [&](const ConfigSection& section) {
    return !is_broadcaster(section) && relevant(section);
  };
  const std::vector<ConfigSection> chosen = chosen_sections(
      all, name, controls, what, all.notes,
      [&](auto& sections, auto& notes) { keep_declared(all.file, sections, notes); });
  std::vector<std::string> names;
  std::string found;
  bool single_joints = true;
  for (const ConfigSection& section : chosen) {
    names.push_back(section.full_name());
    found += (found.empty() ? "" : ", ") + shown(names.back()) + " in line " +
             std::to_string(section.line());
    for (const char* key : {"joints", "dof_names", "joint_names", "gains"}) {
      single_joints = single_joints && section.parameters.find(key) == nullptr;
    }
  }
  if (chosen.size() > 1 && !single_joints) {
    const ConfigSection& second = chosen[1];
    throw FileError({all.file, second.line(), second.parameters.key_mark.column, second.path},
                    "there are several: " + found, one_of_words("", names) + " by name");
  }
  ControllerConfig config = ControllerReader(all.file, chosen.front(), robot, signs).take();
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    put_together(config, ControllerReader(all.file, chosen[k], robot, signs).take());
  }
  config.notes.insert(config.notes.end(), all.notes.begin(), all.notes.end());
  return config;
}

}  // namespace detail

/// Reads a controller's parameters from a file, before there is a robot:
///
///     const ControllerConfig config = load_controller("pid_plus_gravity.yaml");
///     const auto arm = load_urdf<2>("arm.urdf", {.root = config.chain_root,
///                                                .tip = config.chain_tip,
///                                                .gravity = *config.gravity});
///     PidPlusGravity<Model<2>> controller(arm, pid_gains(arm, config).gains);
///
/// Layouts, keys and their meaning: docs/configuration.md. Controllers of one joint each, as ROS 1
/// has them, are put together.
/// @param source  a file, or a ConfigSource::text
/// @param name    of the controller, of a namespace, or the type of the controllers that are meant;
///                need not be given where there is but one
/// @param signs   which p, i and d may have; with `any` output clamps need not contain 0: for
///                ControlToolboxPidLaw
/// @throws FileError with file, line, key and what was expected: no YAML, no such controller or
///         several, an unknown or missing key, a wrong type, a value out of range
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline ControllerConfig load_controller(const ConfigSource& source,
                                                      std::string_view name = {},
                                                      GainSigns signs = GainSigns::not_negative) {
  return detail::load_controller(source, name, detail::has_joints, "controller", nullptr, signs);
}

}  // namespace articula
