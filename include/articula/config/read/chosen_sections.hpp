// SPDX-License-Identifier: Apache-2.0
/// @file The sections of a configuration that a caller means.
#pragma once

#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

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

/// The sections of a file that are meant: those with this name, else the relevant ones in the
/// namespace, of the type or, without a name, in the file.
/// @param notes  receives a line on each section that is left out, if there is no name
/// @throws FileError if there is none
[[nodiscard]] inline std::vector<ConfigSection> chosen_sections(const ConfigSections& all,
                                                                const SectionChoice& choice,
                                                                std::vector<std::string>& notes) {
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
      left_out.push_back(section.fault ? std::string(section.fault->what()) + ": not used"
                                       : section.place(all.file).text() + "not used, it is no " +
                                             choice.what);
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
  notes.insert(notes.end(), left_out.begin(), left_out.end());
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
