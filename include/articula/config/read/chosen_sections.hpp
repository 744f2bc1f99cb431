// SPDX-License-Identifier: Apache-2.0
/// @file Which sections of a configuration are meant.
#pragma once

#include "articula/config/read/robot_joints.hpp"
#include "articula/config/read/section.hpp"
#include "articula/config/yaml/scalar.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// True if a section is named after a joint, not a controller that is.
[[nodiscard]] inline bool is_joint(const ConfigSection& section, const RobotJoints& joints) {
  return section.type.empty() && joints.has(section.name);
}

/// Those sections of a file that are meant.
/// @param name      of a controller, a namespace or a type of controllers; empty: any
/// @param relevant  without a name, sections for which this is false are left out, and noted
/// @param what      is looked for, for the message
/// @param notes     receives what was left out
/// @param narrow    takes those away that are not likely to be meant where several are relevant, and
///                  adds a note on each; none: all count
/// @throws FileError if there is none
[[nodiscard]] inline std::vector<ConfigSection> chosen_sections(
    const ConfigSections& all, std::string_view name,
    const std::function<bool(const ConfigSection&)>& relevant, const std::string& what,
    std::vector<std::string>& notes,
    const std::function<void(std::vector<ConfigSection>&, std::vector<std::string>&)>& narrow =
        nullptr) {
  while (name.starts_with('/')) name.remove_prefix(1);
  std::vector<std::string> names, left_out;
  std::vector<ConfigSection> full, exact, chosen;
  for (const ConfigSection& section : all.sections) {
    if (section.name == "controller_manager") continue;
    names.push_back(section.full_name());
    if (!name.empty() && section.full_name() == name) full.push_back(section);
    if (!name.empty() && section.name == name) exact.push_back(section);
    const bool within = name.empty() || section.type == name || section.group == name ||
                        section.group.starts_with(std::string(name) + "/");
    if (within && relevant(section)) {
      chosen.push_back(section);
    } else if (name.empty() && section.fault) {
      left_out.push_back(std::string(section.fault->what()) + ": not used");
    } else if (name.empty()) {
      left_out.push_back(all.file + ":" + std::to_string(section.line()) + ": " + section.path +
                         ": not used, it is no " + what);
    }
  }
  if (narrow && full.empty() && exact.empty()) narrow(chosen, left_out);
  for (std::vector<ConfigSection>* sections : {&full, &exact, &chosen}) {
    for (const ConfigSection& section : *sections) section.check();
    if (!sections->empty() && sections != &chosen) return *sections;
  }
  // A file that is nothing but parameters is anybody's.
  if (chosen.empty() && all.sections.size() == 1 && all.sections[0].name.empty()) {
    return all.sections;
  }
  notes.insert(notes.end(), left_out.begin(), left_out.end());
  if (!chosen.empty()) return chosen;
  for (const ConfigSection& section : all.sections) {
    if (name.empty()) section.check();  // it may be what was meant
  }
  if (name.empty()) {
    constexpr std::size_t most = 8;
    std::string list;  // of what is there instead
    for (std::size_t k = 0; k < std::min(names.size(), most); ++k) {
      if (!names[k].empty()) list += (list.empty() ? "" : ", ") + shown(names[k]);
    }
    if (names.size() > most) list += ", ...";
    throw FileError({.file = all.file}, "there is no " + what + " in it",
                    list.empty() ? "one" : "one besides " + list);
  }
  throw FileError({.file = all.file}, "there is no " + what + " called '" + shown(name) + "' in it",
                  names.empty() ? "one" : one_of_words(name, names));
}

}  // namespace articula::detail
