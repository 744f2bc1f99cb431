// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of one controller in a configuration file, and those that a caller means.
#pragma once

#include "articula/config/read/robot_joints.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The parameters of one controller, or of the controller manager.
struct ConfigSection {
  std::string name{};      ///< of the controller; empty if the file has nothing but its parameters
  std::string group{};     ///< its namespaces, with slashes between them
  std::string type{};      ///< from the section or from the controller manager; may be empty
  bool is_listed = false;  ///< the controller manager gives its type
  bool is_declared = false;  ///< it has ros__parameters, or a plugin's type of its own
  ConfigNode parameters{};
  std::optional<FileError> fault{};  ///< why it cannot be used; thrown only if it is used
  std::vector<std::string> notes{};  ///< on values that other sections replace

  [[nodiscard]] std::string full_name() const { return group.empty() ? name : group + "/" + name; }
  /// The position of its key.
  [[nodiscard]] const FilePlace& place() const noexcept { return parameters.key_place; }
  void check() const {
    if (fault) throw FileError(*fault);
  }
};

struct ConfigSections {
  std::string file{};
  std::vector<ConfigSection> sections{};
  std::vector<std::string> notes{};
};

inline constexpr std::string_view ros_parameters = "ros__parameters";

[[nodiscard]] inline bool lists_joints(const ConfigNode& parameters) {
  return parameters.has_any({"joints", "dof_names", "joint_names"});
}

/// True if parameters have a plugin's type, which has a slash; a waveform's type has none.
[[nodiscard]] inline bool has_plugin_type(const ConfigNode& parameters) {
  const ConfigNode* type = parameters.find("type");
  return type != nullptr && type->text.find('/') != std::string::npos;
}

/// True if a section is named after a joint and not after a controller.
[[nodiscard]] inline bool is_joint(const ConfigSection& section, const RobotJoints& joints) {
  return section.type.empty() && joints.has(section.name);
}

/// What a caller of chosen_sections looks for.
struct SectionChoice {
  std::string_view name;  ///< of a controller, a namespace or a type of controllers; empty: any
  std::string what;       ///< in messages, "controller with gains"
  std::function<bool(const ConfigSection&)> is_relevant;
  /// Removes sections that are probably not meant, and adds a note on each; may be empty.
  std::function<void(std::vector<ConfigSection>&, std::vector<std::string>&)> narrow{};
};

/// The sections of a file that are meant. They are those with this name. Else they are the relevant
/// ones in the namespace, of the type or, without a name, in the file.
/// @param all  receives a note on each section that is left out, if there is no name
/// @throws FileError if there is none
[[nodiscard]] inline std::vector<ConfigSection> chosen_sections(ConfigSections& all,
                                                                const SectionChoice& choice) {
  std::string_view name = choice.name;
  while (name.starts_with('/')) name.remove_prefix(1);
  std::vector<std::string> names, left_out;
  std::vector<ConfigSection> full, exact, relevant;
  for (const ConfigSection& section : all.sections) {
    if (section.name == "controller_manager") continue;
    names.push_back(section.full_name());
    if (!name.empty() && section.full_name() == name) full.push_back(section);
    if (!name.empty() && section.name == name) exact.push_back(section);
    const bool within = name.empty() || section.type == name || section.group == name ||
                        section.group.starts_with(std::string(name) + "/");
    if (within && choice.is_relevant(section)) {
      relevant.push_back(section);
    } else if (name.empty()) {
      left_out.push_back(section.fault
                             ? std::string(section.fault->what()) + ": not used"
                             : section.place().text() + "not used, it is no " + choice.what);
    }
  }
  if (choice.narrow && full.empty() && exact.empty()) choice.narrow(relevant, left_out);
  for (std::vector<ConfigSection>* sections : {&full, &exact, &relevant}) {
    for (const ConfigSection& section : *sections) section.check();
    if (!sections->empty() && sections != &relevant) return *sections;
  }
  // A file may consist of one section's parameters.
  if (relevant.empty() && all.sections.size() == 1 && all.sections[0].name.empty()) {
    return all.sections;
  }
  all.notes.insert(all.notes.end(), left_out.begin(), left_out.end());
  if (!relevant.empty()) return relevant;
  if (!name.empty()) {
    throw FileError({.file = all.file},
                    "there is no " + choice.what + " called '" + shown(name) + "' in it",
                    names.empty() ? "one" : one_of_words(name, names));
  }
  for (const ConfigSection& section : all.sections) section.check();  // it may be the one
  std::erase(names, "");
  constexpr std::size_t listed = 8;
  throw FileError({.file = all.file}, "there is no " + choice.what + " in it",
                  names.empty() ? "one" : "one besides " + list_of(names, listed));
}

}  // namespace articula::detail
