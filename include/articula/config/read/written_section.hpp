// SPDX-License-Identifier: Apache-2.0
/// @file The sections of a configuration file as written, before wildcards in their names are
/// resolved.
#pragma once

#include "articula/config/read/section.hpp"
#include "articula/config/yaml/merge.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// The name of a section in ROS 2, such as /left/arm. A part * matches one part of a controller's
/// name, and ** any number of parts [rcl_yaml_param_parser and rclcpp's parameter_map_from]. So
/// /**/arm matches each arm, /left/** everything in left, and /** everything.
class SectionName {
 public:
  SectionName() = default;
  explicit SectionName(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('/'), text.size());
      if (end > 0) parts_.emplace_back(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  [[nodiscard]] bool operator==(const SectionName&) const = default;

  /// A name in this namespace.
  [[nodiscard]] SectionName operator/(const SectionName& inner) const {
    SectionName name = *this;
    name.parts_.insert(name.parts_.end(), inner.parts_.begin(), inner.parts_.end());
    return name;
  }

  /// The last part; empty if it is a wildcard, or if there is none.
  [[nodiscard]] std::string last() const {
    return parts_.empty() || is_wildcard(parts_.back()) ? "" : parts_.back();
  }
  /// All parts but the last one, without **, with slashes between them.
  [[nodiscard]] std::string group() const {
    std::string text;
    for (std::size_t k = 0; k + 1 < parts_.size(); ++k) {
      if (parts_[k] != "**") text += (text.empty() ? "" : "/") + parts_[k];
    }
    return text;
  }
  /// A name that this matches, in which * stands for an unknown part.
  [[nodiscard]] SectionName example() const {
    SectionName name = *this;
    std::erase(name.parts_, "**");
    if (!parts_.empty() && parts_.back() == "**") name.parts_.emplace_back("*");
    return name;
  }
  [[nodiscard]] std::size_t depth() const noexcept { return parts_.size(); }
  [[nodiscard]] bool has_wildcard() const {
    return std::any_of(parts_.begin(), parts_.end(), is_wildcard);
  }
  [[nodiscard]] bool has_double_wildcard() const {
    return std::find(parts_.begin(), parts_.end(), "**") != parts_.end();
  }

  /// True if this matches a name.
  [[nodiscard]] bool matches(const SectionName& name) const {
    // reached[k]: the parts so far match the first k parts of the name.
    std::vector<bool> reached(name.parts_.size() + 1, false);
    reached[0] = true;
    for (const std::string& part : parts_) {
      for (std::size_t k = 1; part == "**" && k < reached.size(); ++k) {
        reached[k] = reached[k] || reached[k - 1];
      }
      if (part == "**") continue;
      for (std::size_t k = reached.size() - 1; k > 0; --k) {
        reached[k] = reached[k - 1] && (part == "*" || part == name.parts_[k - 1]);
      }
      reached[0] = false;
    }
    return reached.back();
  }

 private:
  [[nodiscard]] static bool is_wildcard(const std::string& part) {
    return part == "*" || part == "**";
  }

  std::vector<std::string> parts_{};
};

/// A section as written, in the layouts of ROS 1 and ROS 2.
struct WrittenSection {
  SectionName name{};
  ConfigNode parameters{};
  std::optional<FileError> fault{};  ///< why it cannot be used
};

/// Finds the sections of a file, in the order of their parameters, which is ROS 2's order.
class SectionSearch {
 public:
  /// @param notes  receives a line on each value that belongs to no section
  SectionSearch(const ConfigNode& root, std::vector<std::string>& notes) : notes_(&notes) {
    check_spelling(root);
    if (is_namespace(root) || has_only_sections(root)) {
      search(root, {});
    } else {
      add({}, root);
    }
  }

  [[nodiscard]] std::vector<WrittenSection> take() { return std::move(found_); }

 private:
  /// Refuses misspelt ros__parameters. They would change the layout, and no other message would
  /// name the reason.
  void check_spelling(const ConfigNode& map) const {
    for (const ConfigNode& item : map.items) {
      const std::string expected = "'" + std::string(ros_parameters) + "'";
      if (item.key != ros_parameters && is_near(ros_parameters, item.key)) {
        throw FileError(item.key_place, "unknown key '" + shown(item.key) + "'", expected);
      }
      if (item.key == ros_parameters && map.place.key.empty()) {
        throw FileError(item.key_place, expected + " at the top",
                        "it below a controller's name, or /**");
      }
      check_spelling(item);
    }
  }
  [[nodiscard]] static bool is_namespace(const ConfigNode& map) {
    // In a controller's own parameters, a map with joints is one of them.
    const bool has_parameters = std::any_of(map.items.begin(), map.items.end(), is_parameter);
    return std::any_of(map.items.begin(), map.items.end(), [&](const ConfigNode& item) {
      return item.is_map() && (item.find(ros_parameters) != nullptr || has_plugin_type(item) ||
                               (lists_joints(item) && !has_parameters) ||
                               item.key == "controller_manager" || is_namespace(item));
    });
  }
  /// True if an entry is a map that is a parameter of a controller.
  [[nodiscard]] static bool is_parameter(const ConfigNode& item) {
    return item.key == "pid" || item.key == "gains" || item.key == "constraints" ||
           item.key == "chain" || item.key == "gravity" || item.key == "waveforms";
  }
  [[nodiscard]] static bool has_only_sections(const ConfigNode& map) {
    return std::all_of(map.items.begin(), map.items.end(),
                       [](const ConfigNode& item) { return item.is_map() && !is_parameter(item); });
  }

  void search(const ConfigNode& map, const SectionName& group) {
    for (const ConfigNode& item : map.items) {
      const SectionName name = group / SectionName(item.key);
      if (item.key == ros_parameters) {
        add(group, item, item.kind == ConfigNode::Kind::nothing && map.items.size() == 1);
      } else if (!item.is_map()) {
        notes_->push_back(item.key_place.text() + "not used, it belongs to no controller");
      } else if (item.find(ros_parameters) != nullptr ||
                 (item.key != "controller_manager" && !has_plugin_type(item) &&
                  !lists_joints(item) && (is_namespace(item) || has_only_sections(item)))) {
        search(item, name);
      } else {
        add(name, item);
      }
    }
  }

  /// @param is_empty  the section has no parameters, and no others were meant to be in it
  void add(const SectionName& name, const ConfigNode& parameters, bool is_empty = false) {
    WrittenSection section{name, parameters, {}};
    section.parameters.kind = ConfigNode::Kind::map;
    section.parameters.items.clear();
    const FilePlace& place = parameters.place;
    try {
      if (!parameters.is_map() && !is_empty) {
        throw FileError(place, parameters.named(), "a map of parameters, further to the right");
      }
      for (const ConfigNode& item : parameters.items) {
        insert_dotted(place, section.parameters, item.key, item);
      }
    } catch (const FileError& error) {
      section.fault = error;
    }
    const auto same = std::find_if(found_.begin(), found_.end(),
                                   [&](const auto& each) { return each.name == name; });
    if (same == found_.end()) {
      found_.push_back(std::move(section));
      return;
    }
    // The same name, written in two ways: /arm and arm.
    mark_inherited(section.parameters);
    std::vector<std::string> ignored;
    replace_entries(same->parameters, section.parameters, ignored);
    if (!same->fault) same->fault = section.fault;
  }

  std::vector<std::string>* notes_;
  std::vector<WrittenSection> found_{};
};

}  // namespace articula::detail
