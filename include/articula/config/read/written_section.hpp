// SPDX-License-Identifier: Apache-2.0
/// @file The sections of a configuration file as written, before wildcards are resolved.
#pragma once

#include "articula/config/read/section.hpp"
#include "articula/config/read/section_name.hpp"
#include "articula/config/yaml/merge.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace articula::detail {

/// A section as written, in the layouts of ROS 1 and ROS 2.
struct WrittenSection {
  SectionName name{};
  std::string path{};  ///< keys from the top
  ConfigNode parameters{};
  std::optional<FileError> fault{};  ///< why it cannot be used
};

/// Finds the sections of a file, in the order of their parameters, which is ROS 2's order.
class SectionSearch {
 public:
  /// @param notes  receives a line on each value that belongs to no section
  SectionSearch(const ConfigNode& root, const std::string& file, std::vector<std::string>& notes)
      : file_(file), notes_(&notes) {
    check_spelling(root, "");
    if (is_namespace(root) || has_only_sections(root)) {
      search(root, {}, "");
    } else {
      add({}, "", root);
    }
  }

  [[nodiscard]] std::vector<WrittenSection> take() { return std::move(found_); }

 private:
  /// Refuses misspelt ros__parameters. They would change the layout, and no other message would
  /// name the reason.
  void check_spelling(const ConfigNode& map, const std::string& path) const {
    for (const ConfigNode& item : map.items) {
      const std::string here = joined(path, shown(item.key));
      const std::string expected = "'" + std::string(ros_parameters) + "'";
      if (item.key != ros_parameters && is_near(ros_parameters, item.key)) {
        throw FileError(item.key_place(file_, here), "unknown key '" + shown(item.key) + "'",
                        expected);
      }
      if (item.key == ros_parameters && path.empty()) {
        throw FileError(item.key_place(file_, here), expected + " at the top",
                        "it below a controller's name, or /**");
      }
      check_spelling(item, here);
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
  [[nodiscard]] static std::string joined(const std::string& a, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + "." + b;
  }

  void search(const ConfigNode& map, const SectionName& group, const std::string& path) {
    for (const ConfigNode& item : map.items) {
      const std::string here = joined(path, shown(item.key));
      const SectionName name = group / SectionName(item.key);
      if (item.key == ros_parameters) {
        add(group, here, item, item.kind == ConfigNode::Kind::nothing && map.items.size() == 1);
      } else if (!item.is_map()) {
        notes_->push_back(item.key_place(file_, here).text() +
                          "not used, it belongs to no controller");
      } else if (item.find(ros_parameters) != nullptr ||
                 (item.key != "controller_manager" && !has_plugin_type(item) &&
                  !lists_joints(item) && (is_namespace(item) || has_only_sections(item)))) {
        search(item, name, here);
      } else {
        add(name, here, item);
      }
    }
  }

  /// @param is_empty  the section has no parameters, and no others were meant to be in it
  void add(const SectionName& name, const std::string& path, const ConfigNode& parameters,
           bool is_empty = false) {
    WrittenSection section{name, path, parameters, {}};
    section.parameters.kind = ConfigNode::Kind::map;
    section.parameters.items.clear();
    const FilePlace place{file_, parameters.mark.line, parameters.mark.column, path};
    try {
      if (!parameters.is_map() && !is_empty) {
        throw FileError(place, node_text(parameters), "a map of parameters, further to the right");
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
    mark_inherited(section.parameters, path);
    std::vector<std::string> ignored;
    replace_entries(same->parameters, section.parameters, file_, same->path, ignored);
    if (!same->fault) same->fault = section.fault;
  }

  std::string file_;
  std::vector<std::string>* notes_;
  std::vector<WrittenSection> found_{};
};

}  // namespace articula::detail
