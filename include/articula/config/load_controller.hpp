// SPDX-License-Identifier: Apache-2.0
/// @file Reads a controller's parameters from a file, whichever robot it is for. Needs the CMake
/// target articula::config (yaml-cpp).
#pragma once

#include "articula/config/controller_config.hpp"
#include "articula/config/read_controller.hpp"
#include "articula/config/section.hpp"
#include "articula/config/source.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
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

[[nodiscard]] inline bool has_joints(const ConfigSection& section) {
  return has_gains(section) || has_constraints(section) ||
         section.parameters.find("joints") != nullptr;
}

/// One controller, or single-joint controllers as if they were one.
/// @param relevant  see chosen_sections
/// @param what      is looked for, for messages
[[nodiscard]] inline ControllerConfig load_controller(
    const ConfigSource& source, std::string_view name,
    const std::function<bool(const ConfigSection&)>& relevant, const std::string& what) {
  const ConfigSections all = find_sections(source);
  const std::vector<ConfigSection> chosen = chosen_sections(all, name, relevant, what);
  std::vector<std::string> names;
  bool single_joints = true;
  for (const ConfigSection& section : chosen) {
    names.push_back(section.name);
    for (const char* key : {"joints", "dof_names", "joint_names", "gains"}) {
      single_joints = single_joints && section.parameters.find(key) == nullptr;
    }
  }
  if (chosen.size() > 1 && !single_joints) {
    throw ConfigError({.file = all.file}, "there are several", choice_text(names, "") + " by name");
  }
  ControllerConfig config = ControllerReader(all.file, chosen.front()).take();
  for (std::size_t k = 1; k < chosen.size(); ++k) {
    ControllerConfig more = ControllerReader(all.file, chosen[k]).take();
    for (ConfiguredJoint& joint : more.joints) {
      for (const ConfiguredJoint& known : config.joints) {
        if (known.name != joint.name) continue;
        throw ConfigError(
            joint.place,
            "joint '" + shown(joint.name) + "' is also in line " + std::to_string(known.place.line),
            "the name or the type of the controllers that are meant");
      }
      config.joints.push_back(std::move(joint));
    }
    config.notes.insert(config.notes.end(), more.notes.begin(), more.notes.end());
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
///     PidPlusGravity<Model<2>> controller(pid_gains(config, arm).gains, arm);
///
/// Layouts, keys and their meaning: docs/configuration.md. Controllers of one joint each, as ROS 1
/// has them, are put together.
/// @param source  a file, or a ConfigSource::text
/// @param name    of the controller, of a namespace, or the type of the controllers that are meant;
///                need not be given where there is but one
/// @throws ConfigError with file, line, key and what was expected: no YAML, no such controller or
///         several, an unknown or missing key, a wrong type, a value out of range
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline ControllerConfig load_controller(const ConfigSource& source,
                                                      std::string_view name = {}) {
  return detail::load_controller(source, name, detail::has_joints, "controller");
}

}  // namespace articula
