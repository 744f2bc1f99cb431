// SPDX-License-Identifier: Apache-2.0
/// @file Reads the controller manager's parameters from a file. Needs the CMake target
/// articula::config (yaml-cpp).
#pragma once

#include "articula/config/read/find_sections.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/read/unused_parameters.hpp"
#include "articula/config/yaml/reader.hpp"
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

/// The controller manager's parameters that matter to a loop and its thread.
struct ControllerManagerConfig {
  double update_rate = 100;                     ///< [Hz]
  std::vector<ListedController> controllers{};  ///< in the order of the file
  std::optional<int> thread_priority{};         ///< for ThreadOptions
  std::vector<int> processors{};                ///< cpu_affinity, for ThreadOptions; empty: all
  std::optional<bool> lock_memory{};            ///< for ThreadOptions
  /// What the file says and nothing here does, one line each with file, line and key.
  std::vector<std::string> notes{};

  /// Time between two updates [s].
  [[nodiscard]] double period() const noexcept { return 1 / update_rate; }
};

namespace detail {

/// Whether parameters without a name can be those of the controller manager.
[[nodiscard]] inline bool is_manager(const ConfigNode& parameters) {
  for (const char* key : {"update_rate", "thread_priority", "cpu_affinity", "lock_memory"}) {
    if (parameters.find(key) != nullptr) return true;
  }
  return std::any_of(parameters.items.begin(), parameters.items.end(),
                     [](const ConfigNode& item) { return item.find("type") != nullptr; });
}

inline void take_unused_manager_parameters(ConfigMap& map) {
  using enum UnusedParameter::Kind;
  constexpr std::string_view always = "limits are always kept, faults always handled";
  constexpr std::string_view compiled = "the types in the program decide what there is";
  constexpr std::string_view runner = "see RunOptions";
  take_unused(map, {{"use_sim_time", truth, "the loop's clock is a type in the program"},
                    {"robot_description", word, "nothing is published or received here"},
                    {"qos_overrides", any_map, "nothing is published or received here"},
                    {"start_type_description_service", truth, "there are no services"},
                    {"enforce_command_limits", truth, always},
                    {"handle_exceptions", truth, always},
                    {"shutdown_on_initial_state_failure", truth, always},
                    {"hardware_components_initial_state", any_map, compiled},
                    {"defaults", any_map, compiled},
                    {"diagnostics", any_map, "see RunReport"},
                    {"overruns", any_map, runner},
                    {"hardware_synchronization", any_map, runner}});
}

}  // namespace detail

/// Reads update rate, types and thread from the section controller_manager:
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
  const ConfigSection* section = nullptr;
  for (const ConfigSection& each : all.sections) {
    const bool alone = each.name.empty() && all.sections.size() == 1;
    if (each.name != "controller_manager" && !(alone && detail::is_manager(each.parameters))) {
      continue;
    }
    if (section != nullptr) {
      throw FileError({all.file, each.line(), each.parameters.key_mark.column, each.path},
                      "there are several controller managers, another one in line " +
                          std::to_string(section->line()),
                      "one");
    }
    section = &each;
  }
  if (section == nullptr) {
    const auto slip = std::find_if(all.sections.begin(), all.sections.end(), [](const auto& each) {
      return detail::is_near("controller_manager", each.name);
    });
    throw FileError({.file = all.file}, "there is no controller_manager in it",
                    slip == all.sections.end()
                        ? "one"
                        : "one, in place of '" + detail::shown(slip->name) + "'");
  }

  section->check();
  ControllerManagerConfig config{.notes = section->notes};
  ConfigMap map(detail::ConfigValue(all.file, section->parameters, section->path), config.notes,
                Inherited::may_be_unknown);
  if (const auto rate = map.find("update_rate")) {
    config.update_rate = rate->integer(1, 1000000);
  } else {
    map.note(map.value(), "no update_rate is given: 100 Hz, as the controller manager has it");
  }
  if (const auto value = map.find("thread_priority")) {
    config.thread_priority = value->integer(0, 99);
  }
  if (const auto value = map.find("cpu_affinity")) {
    constexpr int most = 4095;
    if (value->node().is_list()) {
      for (const auto& item : value->list()) config.processors.push_back(item.integer(0, most));
    } else if (const int processor = value->integer(-1, most); processor >= 0) {
      config.processors = {processor};
    }
  }
  if (const auto value = map.find("lock_memory")) config.lock_memory = value->truth();
  detail::take_unused_manager_parameters(map);
  for (const detail::ConfigNode& item : section->parameters.items) {
    // What is neither a parameter nor almost one is a controller, which has a type.
    const bool other = map.knows(item.key) || map.nearly_knows(item.key) || item.inherited;
    const bool value = !item.is_map() && item.kind != detail::ConfigNode::Kind::nothing;
    if (!other && value && item.text.find('/') != std::string::npos) {
      map.value().at(item).refuse("a map with the type in it, {type: " + detail::shown(item.text) +
                                  "}");
    }
    if (item.find("type") == nullptr && (other || value)) continue;
    ConfigMap controller = *map.find_map(item.key);
    const auto type = controller.expect("type");
    detail::take_unused_controller_parameters(controller);
    controller.finish();
    config.controllers.push_back({item.key, type->word()});
  }
  map.finish();
  return config;
}

}  // namespace articula
