// SPDX-License-Identifier: Apache-2.0
/// @file Which parameters each controller of a configuration file has, wildcards included.
#pragma once

#include "articula/config/read/section.hpp"
#include "articula/config/read/section_name.hpp"
#include "articula/config/read/written_section.hpp"
#include "articula/config/yaml/document.hpp"
#include "articula/config/yaml/merge.hpp"
#include "articula/config/yaml/source.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Puts the parameters of controllers together as ROS 2 does: each section whose name covers a
/// controller's counts, in the order of the file, and of two values the later one.
class SectionFinder {
 public:
  /// @param wanted  a controller that may be there by a wildcard alone; empty: none
  SectionFinder(const ConfigSource& source, std::string_view wanted)
      : found_{.file = source.name()} {
    const ConfigNode root = read_document(source);
    written_ = SectionSearch(root, found_.file, found_.notes).take();
    used_.resize(written_.size(), false);
    name_controllers(SectionName(wanted));
    for (const Controller& controller : controllers_) apply(controller);
    note_unused();
    find_types();
  }

  [[nodiscard]] ConfigSections take() { return std::move(found_); }

 private:
  /// A controller that there is.
  struct Controller {
    SectionName name;
    std::size_t own;  ///< index of the section that is its own; their number: none
  };

  [[nodiscard]] bool has_controller(const SectionName& pattern) const {
    return std::any_of(controllers_.begin(), controllers_.end(),
                       [&](const Controller& each) { return pattern.covers(each.name); });
  }

  void name_controllers(const SectionName& wanted) {
    for (std::size_t k = 0; k < written_.size(); ++k) {
      if (!written_[k].name.has_wildcard()) controllers_.push_back({written_[k].name, k});
    }
    // /**/arm is the section of any arm: of the one that is asked for, or of some one. Those for
    // one namespace each go first, since /**/arm then means them as well.
    const bool is_known =
        std::any_of(controllers_.begin(), controllers_.end(), [&](const Controller& each) {
          return each.name == wanted || (wanted.depth() == 1 && each.name.last() == wanted.last());
        });
    for (std::size_t k = 0; k < written_.size() && !is_known && wanted.depth() > 0; ++k) {
      const SectionName& name = written_[k].name;
      if (name.last().empty() || !name.has_wildcard() || !name.covers(wanted)) continue;
      controllers_.push_back({wanted, k});
      break;
    }
    for (const bool any_depth : {false, true}) {
      for (std::size_t k = 0; k < written_.size(); ++k) {
        const SectionName& name = written_[k].name;
        if (!name.has_wildcard() || name.last().empty()) continue;
        if (name.has_double_wildcard() != any_depth || has_controller(name)) continue;
        controllers_.push_back({name.example(), k});
      }
    }
    if (std::all_of(controllers_.begin(), controllers_.end(), [](const Controller& each) {
          return each.name.last() == "controller_manager";
        })) {
      name_listed_controllers();
    }
    if (!controllers_.empty() || written_.empty()) return;
    // Nothing but wildcards: parameters of anybody, of the namespace that is the longest.
    const auto deepest = std::max_element(
        written_.begin(), written_.end(),
        [](const auto& a, const auto& b) { return a.name.depth() < b.name.depth(); });
    controllers_.push_back(
        {deepest->name.example(), static_cast<std::size_t>(deepest - written_.begin())});
  }

  /// Controllers of the controller manager that have no section but those with wildcards.
  void name_listed_controllers() {
    const std::vector<Controller> managers = controllers_;
    for (const Controller& manager : managers) {
      for (const ConfigNode& item : written_[manager.own].parameters.items) {
        const ConfigNode* type = item.find("type");
        if (type == nullptr || type->text.ends_with("Broadcaster")) continue;
        const SectionName name = SectionName(manager.name.group()) / SectionName(item.key);
        const bool covered = std::any_of(written_.begin(), written_.end(), [&](const auto& each) {
          return each.name.has_wildcard() && each.name.covers(name);
        });
        if (covered) controllers_.push_back({name, written_.size()});
      }
    }
  }

  void apply(const Controller& controller) {
    const bool has_own = controller.own < written_.size();
    ConfigSection section{.name = controller.name.last(), .group = controller.name.group()};
    section.parameters.kind = ConfigNode::Kind::map;
    if (has_own) {
      const WrittenSection& own = written_[controller.own];
      section.path = own.path;
      section.parameters = own.parameters;
      section.fault = own.fault;
      used_[controller.own] = true;
    }
    // What comes later is stronger, what comes earlier weaker, the nearer the stronger.
    const std::size_t own = has_own ? controller.own : 0;
    for (std::size_t k = own + (has_own ? 1 : 0); k < written_.size(); ++k) {
      if (covers(k, controller)) replace(section, written_[k]);
    }
    for (std::size_t k = own; k-- > 0;) {
      if (covers(k, controller)) add_missing(section.parameters, inherited(written_[k]));
    }
    found_.sections.push_back(std::move(section));
  }
  [[nodiscard]] bool covers(std::size_t k, const Controller& controller) {
    const bool does = written_[k].name.has_wildcard() && written_[k].name.covers(controller.name);
    used_[k] = used_[k] || does;
    return does && !written_[k].fault;
  }

  void replace(ConfigSection& section, const WrittenSection& later) {
    const ConfigNode parameters = inherited(later);
    if (section.path.empty()) {  // it has none of its own
      section.path = later.path;
      section.parameters.mark = parameters.mark;
      section.parameters.key_mark = parameters.key_mark;
    }
    std::vector<Replacement> replaced;
    replace_entries(section.parameters, parameters, section.path, replaced);
    for (const Replacement& each : replaced) {
      section.notes.push_back(found_.file + ":" + std::to_string(each.mark.line) + ": " +
                              each.path + ": not used: " + each.by + " in line " +
                              std::to_string(each.line) + " comes later and counts, as in ROS 2");
    }
  }

  /// The parameters of a section for another one.
  [[nodiscard]] ConfigNode inherited(const WrittenSection& section) {
    nodes_ += node_count(section.parameters);
    if (nodes_ > ConfigBuilder::most_nodes) {
      throw FileError({.file = found_.file}, "it is too large, wildcards included",
                      "at most " + std::to_string(ConfigBuilder::most_nodes) + " values");
    }
    ConfigNode parameters = section.parameters;
    mark_inherited(parameters, section.path);
    return parameters;
  }

  void note_unused() {
    for (std::size_t k = 0; k < written_.size(); ++k) {
      const WrittenSection& section = written_[k];
      const bool broken = section.name.has_wildcard() && section.fault;
      if (broken) found_.notes.push_back(std::string(section.fault->what()) + ": not used");
      if (used_[k] || broken) continue;
      found_.notes.push_back(found_.file + ":" + std::to_string(section.parameters.key_mark.line) +
                             ": " + section.path + ": not used, no section is in this namespace");
    }
  }

  /// A controller's type stands with its parameters in ROS 1, with the controller manager in ROS 2:
  /// that of its namespace if there is one.
  void find_types() {
    const auto manager_of = [&](const ConfigSection& section) {
      const ConfigNode* manager = nullptr;
      for (const ConfigSection& each : found_.sections) {
        const bool own = each.group == section.group;
        if (each.name == "controller_manager" && (own || manager == nullptr)) {
          manager = &each.parameters;
        }
      }
      return manager;
    };
    for (ConfigSection& section : found_.sections) {
      const ConfigNode* type = section.parameters.find("type");
      const ConfigNode* manager = manager_of(section);
      const ConfigNode* entry = manager != nullptr ? manager->find(section.name) : nullptr;
      const ConfigNode* listed = entry != nullptr ? entry->find("type") : nullptr;
      // What has no place of its own is there by a wildcard, and wildcards have ros__parameters.
      section.is_declared = section.path.empty() || section.path.ends_with(ros_parameters) ||
                            (type != nullptr && type->text.find('/') != std::string::npos);
      section.is_listed = listed != nullptr;
      if (type == nullptr) type = listed;
      if (type != nullptr && type->kind == ConfigNode::Kind::scalar) section.type = type->text;
    }
  }

  ConfigSections found_;
  std::vector<WrittenSection> written_{};
  std::vector<bool> used_{};  ///< of those: it is that of a controller
  std::vector<Controller> controllers_{};
  std::size_t nodes_ = 0;  ///< that came from wildcards
};

/// All sections of a file.
/// @param wanted  a controller that may be there by a wildcard alone; empty: none
/// @throws FileError if it is no YAML, or not of the kind that has sections
[[nodiscard]] inline ConfigSections find_sections(const ConfigSource& source,
                                                  std::string_view wanted = {}) {
  return SectionFinder(source, wanted).take();
}

}  // namespace articula::detail
