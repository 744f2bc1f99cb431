// SPDX-License-Identifier: Apache-2.0
/// @file Loads the controller manager's parameters from a file. Needs the CMake target
/// articula::config (yaml-cpp).
#pragma once

#include "articula/config/read/find_sections.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/read/unused_parameters.hpp"
#include "articula/config/yaml/config_map.hpp"
#include "articula/config/yaml/source.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A controller that the controller manager knows.
struct ListedController {
  std::string name{};
  std::string type{};  ///< the plugin's name, such as joint_trajectory_controller/...
};

/// The controller manager's parameters for a loop and its thread.
struct ControllerManagerConfig {
  double update_rate = 100;                     ///< [Hz]
  std::vector<ListedController> controllers{};  ///< in the order of the file
  std::optional<int> thread_priority{};         ///< for ThreadOptions
  std::vector<int> processors{};                ///< cpu_affinity, for ThreadOptions; empty: all
  std::optional<bool> lock_memory{};            ///< for ThreadOptions
  /// Parameters without effect in this library, one line each with file, line and key.
  std::vector<std::string> notes{};

  /// Time between two updates [s].
  [[nodiscard]] double period() const noexcept { return 1 / update_rate; }
};

namespace detail {

/// True if parameters without a name may be those of the controller manager.
[[nodiscard]] inline bool is_manager(const ConfigNode& parameters) {
  if (parameters.has_any({"update_rate", "thread_priority", "cpu_affinity", "lock_memory"})) {
    return true;
  }
  return std::any_of(parameters.items.begin(), parameters.items.end(),
                     [](const ConfigNode& item) { return item.find("type") != nullptr; });
}

inline void take_unused_manager_parameters(ConfigMap& map) {
  using enum UnusedParameters::Kind;
  constexpr std::string_view topics = "articula has its own topics and rates";
  constexpr std::string_view always = "the loop always keeps limits and handles faults";
  constexpr std::string_view types = "the types in the program decide what there is";
  take_unused(
      map, {{truth, "the loop's clock is a type in the program", {"use_sim_time"}},
            {word, topics, {"robot_description"}},
            {any_map, topics, {"qos_overrides"}},
            {truth, topics, {"start_type_description_service"}},
            {truth,
             always,
             {"enforce_command_limits", "handle_exceptions", "shutdown_on_initial_state_failure"}},
            {any_map, types, {"hardware_components_initial_state", "defaults"}},
            {any_map, "see RunReport", {"diagnostics"}},
            {any_map, "see RunOptions", {"overruns", "hardware_synchronization"}}});
}

/// The section of the controller manager.
/// @throws FileError if there is none, or several
[[nodiscard]] inline const ConfigSection* manager_section(const ConfigSections& all) {
  const ConfigSection* manager = nullptr;
  std::vector<std::string_view> names;
  for (const ConfigSection& each : all.sections) {
    names.push_back(each.name);
    const bool is_whole_file = each.name.empty() && all.sections.size() == 1;
    if (each.name != "controller_manager" && !(is_whole_file && is_manager(each.parameters))) {
      continue;
    }
    if (manager != nullptr) {
      throw FileError(each.place(),
                      "there are several controller managers, another one in line " +
                          std::to_string(manager->place().line),
                      "one");
    }
    manager = &each;
  }
  if (manager != nullptr) return manager;
  const std::string_view misspelt = similar_word("controller_manager", names);
  throw FileError({.file = all.file}, "there is no controller_manager in it",
                  misspelt.empty() ? "one" : "one, in place of '" + shown(misspelt) + "'");
}

}  // namespace detail

/// Loads update rate, types and thread parameters from the section controller_manager:
///
///     const ControllerManagerConfig manager = load_controller_manager("controllers.yaml");
///     Loop<Q2dSim, PidPlusGravity> loop(Q2dSim({.period = manager.period()}));
///
/// @param source  a file, or a ConfigSource::text
/// @throws FileError with file, line, key and what was expected
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline ControllerManagerConfig load_controller_manager(const ConfigSource& source) {
  using detail::ConfigMap;
  using detail::ConfigSection;
  using detail::Inherited;
  const detail::ConfigSections all = detail::find_sections(source);
  const ConfigSection* section = detail::manager_section(all);
  section->check();
  ControllerManagerConfig config{.notes = section->notes};
  ConfigMap map(section->parameters, config.notes, Inherited::may_be_unknown);
  if (const auto rate = map.find("update_rate")) {
    config.update_rate = rate->integer(1, 1000000);
  } else {
    map.note(map.node(), "no update_rate is given: 100 Hz, as the controller manager has it");
  }
  if (const auto value = map.find("thread_priority")) {
    config.thread_priority = value->integer(0, 99);
  }
  if (const auto value = map.find("cpu_affinity")) {
    constexpr int most = 4095;
    if (value->is_list()) {
      for (const auto& item : value->list()) config.processors.push_back(item.integer(0, most));
    } else if (const int processor = value->integer(-1, most); processor >= 0) {
      config.processors = {processor};
    }
  }
  if (const auto value = map.find("lock_memory")) config.lock_memory = value->truth();
  detail::take_unused_manager_parameters(map);
  for (const detail::ConfigNode& item : section->parameters.items) {
    // Other entries than parameters, misspelt ones included, are controllers, which have a type.
    const bool is_parameter = map.knows(item.key) || map.nearly_knows(item.key) || item.inherited;
    const bool is_value = !item.is_map() && item.kind != detail::ConfigNode::Kind::nothing;
    if (!is_parameter && is_value && item.text.find('/') != std::string::npos) {
      item.refuse("a map with the type in it, {type: " + detail::shown(item.text) + "}");
    }
    if (item.find("type") == nullptr && (is_parameter || is_value)) continue;
    ConfigMap controller = *map.find_map(item.key);
    const auto type = controller.require("type");
    detail::take_unused_controller_parameters(controller);
    controller.finish();
    config.controllers.push_back({item.key, type->word()});
  }
  map.finish();
  return config;
}

}  // namespace articula
