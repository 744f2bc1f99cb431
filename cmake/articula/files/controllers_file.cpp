// SPDX-License-Identifier: Apache-2.0
#include "files/controllers_file.hpp"

#include "program.hpp"

#include <articula/config/load_controller.hpp>
#include <articula/config/load_controller_manager.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

namespace terminal {

namespace {

using articula::ControllerConfig;
using articula::FileError;

constexpr std::array<KindTraits, 8> kinds{
    {{"Bypass", "bypass", false, Drives::efforts},
     {"Pid", "pid", true, Drives::efforts},
     {"PidPlusGravity", "pid_plus_gravity", true, Drives::efforts},
     {"ComputedTorque", "computed_torque", true, Drives::efforts},
     {"VelocityByEffort", "velocity_by_effort", true, Drives::efforts},
     {"PositionByVelocity", "position_by_velocity", true, Drives::velocities},
     {"ForwardVelocity", "forward_velocity", false, Drives::velocities},
     {"ForwardPosition", "forward_position", false, Drives::positions}}};

bool has_gains(const ControllerConfig& config) {
  return std::ranges::any_of(config.joints,
                             [](const auto& joint) { return joint.gains.has_value(); });
}

/// Whether a section of a controller has tolerances of trajectories.
bool has_tolerances(const articula::detail::ConfigSections& all, const std::string& name) {
  return std::ranges::any_of(all.sections, [&](const auto& section) {
    return (section.name == name || section.type == name) &&
           articula::detail::has_constraints(section);
  });
}

/// The interface that a controller commands, if the file tells: "effort", "velocity", "position".
std::string interface_of(const articula::detail::ConfigSections& all, const std::string& name) {
  for (const auto& section : all.sections) {
    if (section.name != name) continue;
    if (const auto* word = section.parameters.find("interface_name")) return word->text;
    const auto* list = section.parameters.find("command_interfaces");
    if (list != nullptr && list->items.size() == 1) return list->items.front().text;
  }
  return "";
}

/// The class that a plugin's type, or if there is none a controller's name, means; nothing if there
/// is no such class.
std::optional<ControllerKind> kind_of(const ControllerConfig& config,
                                      const std::string& interface) {
  const std::string& whole = config.type.empty() ? config.name : config.type;
  std::string type;  // small letters without what separates words
  for (const char c : whole.substr(whole.find_last_of('/') + 1)) {
    if (c == '_' || c == ' ') continue;
    type += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  const auto has = [&type](std::string_view word) { return type.find(word) != std::string::npos; };
  using enum ControllerKind;
  if (has("computedtorque") || has("inversedynamics")) return computed_torque;
  if (has("pidplusgravity") || has("gravitycompensation")) return pid_plus_gravity;
  if (has("velocitycontroller")) return has_gains(config) ? velocity_by_effort : forward_velocity;
  if (has("effortcontroller") || has("bypass") || has("torquecontroller")) return bypass;
  const bool knows_position = has("positioncontroller") || has("trajectorycontroller") ||
                              has("pidcontroller") || config.type.empty();
  const bool to_velocities =
      interface == "velocity" || config.type.starts_with("velocity_controllers/");
  if (has("gripper") && has_gains(config) && config.type.starts_with("effort_controllers/"))
    return pid;
  if (knows_position && has_gains(config)) return to_velocities ? position_by_velocity : pid;
  if (has("positioncontroller") || has("trajectorycontroller") || has("forwardcommand") ||
      has("gripper")) {
    if (interface == "effort" && !has_gains(config)) {
      if (has("forwardcommand")) return bypass;
      throw FileError(config.place,
                      "controller '" + config.name + "' commands efforts and has no gains",
                      "gains, such as <joint>: {p: ...}");
    }
    return interface == "velocity" ? forward_velocity : forward_position;
  }
  return std::nullopt;
}

/// The plan as it grows, and what became of the other controllers.
struct Reading {
  ControllersPlan plan{};
  std::vector<std::string> chosen{};    ///< empty: all
  std::vector<std::string> left_out{};  ///< a line each

  [[nodiscard]] bool wants(const std::string& name) const {
    return chosen.empty() || std::ranges::find(chosen, name) != chosen.end();
  }
  void leave_out(const std::string& name, const std::string& reason) {
    const std::string line = plan.source.name() + ": controller '" + name + "': " + reason;
    if (!chosen.empty()) throw Refusal(line);
    left_out.push_back(line);
  }
};

void add(Reading& reading, const articula::detail::ConfigSections& all,
         const ControllerConfig& config, const std::string& name, const std::string& section,
         const std::string& interface) {
  ControllersPlan& plan = reading.plan;
  const std::optional<ControllerKind> kind = kind_of(config, interface);
  if (!kind) return reading.leave_out(name, "the type '" + config.type + "' is not known");
  const Drives drives = traits_of(*kind).drives;
  if (plan.controllers.empty()) plan.drives = drives;
  if (drives != plan.drives) {
    return reading.leave_out(
        name, "it does not command the same quantity as '" + plan.controllers.front().name + "'");
  }
  const bool has_parameters =
      std::ranges::any_of(all.sections, [&](const auto& own) { return own.name == section; });
  if (traits_of(*kind).has_gains && !has_parameters) {
    throw Refusal(plan.source.name() + ": controller '" + name +
                  "' has no gains; expected a section '" + name +
                  "' with them, here or in a further file");
  }
  for (const std::string& note : config.notes) {  // of the whole file, so several have the same
    if (std::ranges::find(plan.notes, note) == plan.notes.end()) plan.notes.push_back(note);
  }
  if (config.gravity) plan.gravity = config.gravity;
  if (!config.chain_root.empty()) plan.root = config.chain_root;
  if (!config.chain_tip.empty()) plan.tip = config.chain_tip;
  if (config.priority && plan.priority == 0) plan.priority = *config.priority;
  plan.controllers.push_back({name.empty() ? std::string(traits_of(*kind).name) : name, section,
                              *kind, config, has_tolerances(all, section)});
}

bool is_broadcaster(const articula::ListedController& controller) {
  return controller.type.ends_with("Broadcaster") || controller.name.ends_with("_broadcaster") ||
         controller.type.ends_with("JointStateController");
}

/// Adds the controllers that the manager lists. Several of the same type with one joint each are
/// one controller, with the type as its name, as load_pid_gains combines them.
void add_listed(Reading& reading, const articula::ControllerManagerConfig& manager) {
  const articula::ConfigSource& source = reading.plan.source;
  const auto all = articula::detail::find_sections(source);
  std::map<std::string, int> single;  // controllers of one joint, by type
  for (const auto& section : all.sections) {
    const bool is_gripper = section.type.ends_with("/GripperActionController");
    if (section.is_listed && !is_gripper && articula::detail::is_single_joint(section)) {
      ++single[section.type];
    }
  }
  std::vector<std::string> combined;
  for (const articula::ListedController& listed : manager.controllers) {
    if (is_broadcaster(listed)) continue;
    if (single[listed.type] > 1) {
      if (std::ranges::find(combined, listed.type) != combined.end()) continue;
      combined.push_back(listed.type);
      const std::string name = listed.type.substr(listed.type.find_last_of('/') + 1);
      if (!reading.wants(name)) continue;
      add(reading, all, articula::load_controller(source, listed.type), name, listed.type,
          interface_of(all, listed.name));
      continue;
    }
    if (!reading.wants(listed.name)) continue;
    const bool has_section = std::ranges::any_of(
        all.sections, [&](const auto& section) { return section.name == listed.name; });
    ControllerConfig config{.name = listed.name, .type = listed.type};
    if (has_section) config = articula::load_controller(source, listed.name);
    if (config.type.empty()) config.type = listed.type;
    add(reading, all, config, listed.name, has_section ? listed.name : "",
        interface_of(all, listed.name));
  }
}

}  // namespace

const KindTraits& traits_of(ControllerKind kind) { return kinds[static_cast<std::size_t>(kind)]; }

std::vector<std::string> sections_with_tolerances(const ControllersPlan& plan) {
  std::vector<std::string> sections;
  for (const PlannedController& controller : plan.controllers) {
    if (controller.has_tolerances) sections.push_back(controller.section);
  }
  return sections;
}

int default_substeps(double period) {
  return std::max(1, static_cast<int>(std::ceil(period / 1e-3 - 1e-9)));
}

ControllersPlan read_controllers(const articula::ConfigSource& source,
                                 const std::vector<std::string>& chosen) {
  const std::string& file = source.name();
  Reading reading{.plan = {.source = source}, .chosen = chosen};
  ControllersPlan& plan = reading.plan;
  const auto all = articula::detail::find_sections(source);
  const bool has_manager = std::ranges::any_of(all.sections, [](const auto& section) {
    return section.name == "controller_manager" ||
           (section.name.empty() && articula::detail::is_manager(section.parameters));
  });
  if (has_manager) {
    const auto manager = articula::load_controller_manager(source);
    plan.notes = manager.notes;
    plan.period = manager.period();
    plan.priority = manager.thread_priority.value_or(0);
    plan.processors = manager.processors;
    add_listed(reading, manager);
  } else {
    const ControllerConfig config = articula::load_controller(source);
    plan.notes.push_back(file + ": there is no controller_manager; the loop runs at 1000 Hz");
    add(reading, all, config, config.name, config.name, interface_of(all, config.name));
  }
  for (const std::string& name : chosen) {
    const bool is_there = std::ranges::any_of(
        plan.controllers, [&](const PlannedController& each) { return each.name == name; });
    if (!is_there) throw Refusal(file + ": it names no controller '" + name + "'");
  }
  if (plan.controllers.empty()) {
    std::string reasons;
    for (const std::string& line : reading.left_out) reasons += "; " + line;
    throw Refusal(file + ": it names no controller of joints that can run" + reasons);
  }
  // Here the file, not a program, decides what is commanded and which controllers there are.
  std::erase_if(plan.notes, [](const std::string& note) {
    return note.find("the types in the program decide") != std::string::npos;
  });
  plan.substeps = default_substeps(plan.period);
  for (const std::string& line : reading.left_out) plan.notes.push_back(line + ": it is left out");
  return plan;
}

articula::ConfigSource controllers_source(const std::vector<std::string>& files,
                                          const articula::ConfigValues& values) {
  for (const std::string& file : files) {
    if (!file.ends_with(".urdf") && !file.ends_with(".xacro")) continue;
    throw Refusal(file + ": it is a robot; the robot comes first, and then the YAML files");
  }
  articula::ConfigSource source(files.front(), values);
  for (std::size_t k = 1; k < files.size(); ++k) {
    source = source.with(articula::ConfigSource(files[k], values));
  }
  return source;
}

void add_values_option(CLI::App& command, articula::ConfigValues& values) {
  command
      .add_option_function<std::vector<std::string>>(
          "--value",
          [&values](const std::vector<std::string>& words) {
            for (const std::string& word : words) {
              const std::size_t at = word.find('=');
              values[word.substr(0, at)] = word.substr(at + 1);
            }
          },
          "a value for a placeholder of the YAML: tf_prefix=left_ for $(var tf_prefix)")
      ->type_name("NAME=TEXT")
      ->check([](const std::string& word) {
        const std::size_t at = word.find('=');
        return at == std::string::npos || at == 0 ? "'" + word + "' is not NAME=TEXT"
                                                  : std::string();
      })
      ->allow_extra_args(false);
}

}  // namespace terminal
