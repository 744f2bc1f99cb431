// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of each controller in a configuration file, sections with wildcards
/// included.
#pragma once

#include "articula/config/read/section.hpp"
#include "articula/config/read/written_section.hpp"
#include "articula/config/yaml/document.hpp"
#include "articula/config/yaml/merge.hpp"
#include "articula/config/yaml/source.hpp"
#include "articula/text/file_error.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Combines the parameters of controllers as ROS 2 does. All sections whose names match count, in
/// the order of the file. Of two values of a key the later one counts.
class SectionFinder {
 public:
  /// @param wanted  a controller for which wildcards alone may match; empty: none
  SectionFinder(const ConfigSource& source, std::string_view wanted)
      : found_{.file = source.name()} {
    read(source);
    is_used_.resize(written_.size(), false);
    name_controllers(SectionName(wanted));
    for (const Controller& controller : controllers_) combine(controller);
    note_unused();
    find_types();
  }

  [[nodiscard]] ConfigSections take() { return std::move(found_); }

 private:
  struct Controller {
    SectionName name;
    std::size_t own;  ///< index of its own section; the number of sections: it has none
  };

  /// Finds the sections of a file, and those of the files behind it.
  void read(const ConfigSource& source) {
    const ConfigNode root = read_document(source);
    std::vector<WrittenSection> own = SectionSearch(root, found_.notes).take();
    std::move(own.begin(), own.end(), std::back_inserter(written_));
    for (const ConfigSource& further : source.further()) read(further);
  }

  /// Lists the controllers: first those with sections of their own, then those that wildcards alone
  /// match.
  void name_controllers(const SectionName& wanted) {
    for (std::size_t k = 0; k < written_.size(); ++k) {
      if (!written_[k].name.has_wildcard()) controllers_.push_back({written_[k].name, k});
    }
    const bool is_known =
        std::any_of(controllers_.begin(), controllers_.end(), [&](const Controller& each) {
          return each.name == wanted || (wanted.depth() == 1 && each.name.last() == wanted.last());
        });
    // /**/arm is the section of the wanted controller, or else of an unnamed one.
    for (std::size_t k = 0; k < written_.size() && !is_known && wanted.depth() > 0; ++k) {
      if (written_[k].name.last().empty() || !written_[k].name.matches(wanted)) continue;
      controllers_.push_back({wanted, k});
      break;
    }
    // Sections of one namespace come first, since /**/arm matches them, too.
    for (const bool any_depth : {false, true}) {
      for (std::size_t k = 0; k < written_.size(); ++k) {
        const SectionName& name = written_[k].name;
        const bool is_candidate =
            name.has_wildcard() && !name.last().empty() && name.has_double_wildcard() == any_depth;
        const bool has_match =
            std::any_of(controllers_.begin(), controllers_.end(),
                        [&](const Controller& each) { return name.matches(each.name); });
        if (is_candidate && !has_match) controllers_.push_back({name.example(), k});
      }
    }
    if (std::all_of(controllers_.begin(), controllers_.end(), [](const Controller& each) {
          return each.name.last() == "controller_manager";
        })) {
      name_listed_controllers();
    }
    if (!controllers_.empty() || written_.empty()) return;
    // There are only wildcards: the parameters are those of the longest namespace.
    const auto deepest = std::max_element(
        written_.begin(), written_.end(),
        [](const auto& a, const auto& b) { return a.name.depth() < b.name.depth(); });
    controllers_.push_back(
        {deepest->name.example(), static_cast<std::size_t>(deepest - written_.begin())});
  }

  /// Adds controllers that the controller manager lists and that only wildcards match.
  void name_listed_controllers() {
    const std::vector<Controller> managers = controllers_;
    for (const Controller& manager : managers) {
      for (const ConfigNode& item : written_[manager.own].parameters.items) {
        const ConfigNode* type = item.find("type");
        if (type == nullptr || type->text.ends_with("Broadcaster")) continue;
        const SectionName name = SectionName(manager.name.group()) / SectionName(item.key);
        if (std::any_of(written_.begin(), written_.end(),
                        [&](const auto& each) { return each.name.matches(name); })) {
          controllers_.push_back({name, written_.size()});
        }
      }
    }
  }

  /// Combines the sections of a controller. Values of its own section replace those of earlier
  /// sections. Values of later sections replace its own.
  void combine(const Controller& controller) {
    const bool has_own = controller.own < written_.size();
    ConfigSection section{.name = controller.name.last(), .group = controller.name.group()};
    section.parameters.kind = ConfigNode::Kind::map;
    if (has_own) {
      section.parameters = written_[controller.own].parameters;
      section.fault = written_[controller.own].fault;
      is_used_[controller.own] = true;
    }
    const std::size_t own = has_own ? controller.own : 0;
    for (std::size_t k = has_own ? own + 1 : 0; k < written_.size(); ++k) {
      if (!applies(k, controller)) continue;
      const ConfigNode parameters = inherited(written_[k]);
      if (section.parameters.place.key.empty()) {  // it has no section of its own
        section.parameters.place = parameters.place;
        section.parameters.key_place = parameters.key_place;
      }
      replace_entries(section.parameters, parameters, section.notes);
    }
    for (std::size_t k = own; k-- > 0;) {
      if (applies(k, controller)) add_missing(section.parameters, inherited(written_[k]));
    }
    found_.sections.push_back(std::move(section));
  }
  [[nodiscard]] bool applies(std::size_t k, const Controller& controller) {
    const bool matches = written_[k].name.matches(controller.name);
    is_used_[k] = is_used_[k] || matches;
    return matches && !written_[k].fault;
  }
  /// The parameters of a section, marked as inherited.
  [[nodiscard]] ConfigNode inherited(const WrittenSection& section) {
    nodes_ += node_count(section.parameters);
    if (nodes_ > ConfigBuilder::most_nodes) {
      throw FileError({.file = found_.file}, "it is too large, copies for wildcards included",
                      "at most " + std::to_string(ConfigBuilder::most_nodes) + " values");
    }
    ConfigNode parameters = section.parameters;
    mark_inherited(parameters);
    return parameters;
  }

  void note_unused() {
    for (std::size_t k = 0; k < written_.size(); ++k) {
      const WrittenSection& section = written_[k];
      if (section.name.has_wildcard() && section.fault) {
        found_.notes.push_back(std::string(section.fault->what()) + ": not used");
      } else if (!is_used_[k]) {
        found_.notes.push_back(section.parameters.key_place.text() +
                               "not used, no section is in this namespace");
      }
    }
  }

  /// Finds the types of controllers. In ROS 1 a controller's parameters have it. In ROS 2 the
  /// controller manager has it, preferably that of the same namespace.
  void find_types() {
    const auto manager_of = [&](const ConfigSection& section) {
      const ConfigNode* manager = nullptr;
      for (const ConfigSection& each : found_.sections) {
        const bool same_group = each.group == section.group;
        if (each.name == "controller_manager" && (same_group || manager == nullptr)) {
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
      // Sections with wildcards have ros__parameters.
      const std::string& path = section.place().key;
      section.is_declared =
          path.empty() || path.ends_with(ros_parameters) || has_plugin_type(section.parameters);
      section.is_listed = listed != nullptr;
      if (type == nullptr) type = listed;
      if (type != nullptr && type->kind == ConfigNode::Kind::scalar) section.type = type->text;
    }
  }

  ConfigSections found_;
  std::vector<WrittenSection> written_{};
  std::vector<bool> is_used_{};  ///< of `written_`: it has parameters of a controller
  std::vector<Controller> controllers_{};
  std::size_t nodes_ = 0;  ///< that are inherited
};

/// The sections of a file.
/// @param wanted  a controller for which wildcards alone may match; empty: none
/// @throws FileError if the file is not YAML, or has no sections
[[nodiscard]] inline ConfigSections find_sections(const ConfigSource& source,
                                                  std::string_view wanted = {}) {
  return SectionFinder(source, wanted).take();
}

}  // namespace articula::detail
