// SPDX-License-Identifier: Apache-2.0
/// @file The sections of a configuration file as they are written, wildcards and all.
#pragma once

#include "articula/config/read/section.hpp"
#include "articula/config/read/section_name.hpp"
#include "articula/config/yaml/config_value.hpp"
#include "articula/config/yaml/document.hpp"
#include "articula/config/yaml/merge.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// A section as it is written, in the layouts of ROS 1 and ROS 2.
struct WrittenSection {
  SectionName name{};
  std::string path{};  ///< the keys from the top
  ConfigNode parameters{};
  std::optional<FileError> fault{};  ///< why it cannot be used
};

/// Finds the sections of a file, in the order in which ROS 2 takes them: that of their parameters.
class SectionSearch {
 public:
  /// @param notes  receives what belongs to no section
  SectionSearch(const ConfigNode& root, const std::string& file, std::vector<std::string>& notes)
      : file_(file), notes_(&notes) {
    check_spelling(root, "");
    if (is_namespace(root) || is_of_maps(root)) {
      search(root, {}, "");
    } else {
      add({}, "", root);
    }
  }

  [[nodiscard]] std::vector<WrittenSection> take() { return std::move(found_); }

 private:
  /// Plugins' names have a slash: this tells the type of a controller from that of a signal.
  [[nodiscard]] static bool has_type(const ConfigNode& node) {
    const ConfigNode* type = node.find("type");
    return type != nullptr && type->text.find('/') != std::string::npos;
  }
  /// A slip here would make other parameters of a file, and no message would name the reason.
  void check_spelling(const ConfigNode& map, const std::string& path) const {
    for (const ConfigNode& item : map.items) {
      const std::string here = joined(path, shown(item.key));
      const std::size_t apart = edit_distance(ros_parameters, item.key);
      const FilePlace place{file_, item.key_mark.line, item.key_mark.column, here};
      const std::string expected = "'" + std::string(ros_parameters) + "'";
      if (apart <= 2 && item.key != ros_parameters) {
        throw FileError(place, "unknown key '" + shown(item.key) + "'", expected);
      }
      if (apart == 0 && path.empty()) {
        throw FileError(place, expected + " at the top", "it below a controller's name, or /**");
      }
      check_spelling(item, here);
    }
  }
  [[nodiscard]] static bool is_namespace(const ConfigNode& map) {
    // Beside a controller's own parameters, a map with joints is one of them.
    const bool has_parameters = std::any_of(map.items.begin(), map.items.end(), is_parameter);
    return std::any_of(map.items.begin(), map.items.end(), [&](const ConfigNode& item) {
      return item.is_map() && (item.find(ros_parameters) != nullptr || has_type(item) ||
                               (lists_joints(item) && !has_parameters) ||
                               item.key == "controller_manager" || is_namespace(item));
    });
  }
  [[nodiscard]] static bool lists_joints(const ConfigNode& node) {
    return node.find("joints") != nullptr || node.find("dof_names") != nullptr ||
           node.find("joint_names") != nullptr;
  }
  /// A parameter of a controller that is a map, so no section.
  [[nodiscard]] static bool is_parameter(const ConfigNode& item) {
    static constexpr std::array<std::string_view, 6> parameters = {
        "pid", "gains", "constraints", "chain", "gravity", "waveforms"};
    return std::find(parameters.begin(), parameters.end(), item.key) != parameters.end();
  }
  [[nodiscard]] static bool is_of_maps(const ConfigNode& map) {
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
        const bool says_nothing = item.kind == ConfigNode::Kind::nothing && map.items.size() == 1;
        add(group, here, item, says_nothing);
      } else if (!item.is_map()) {
        notes_->push_back(file_ + ":" + std::to_string(item.key_mark.line) + ": " + here +
                          ": not used, it belongs to no controller");
      } else if (item.find(ros_parameters) != nullptr ||
                 (item.key != "controller_manager" && !has_type(item) && !lists_joints(item) &&
                  (is_namespace(item) || is_of_maps(item)))) {
        search(item, name, here);
      } else {
        add(name, here, item);
      }
    }
  }

  /// @param says_nothing  there is nothing, and nothing that was to be in it
  void add(const SectionName& name, const std::string& path, const ConfigNode& parameters,
           bool says_nothing = false) {
    WrittenSection section{name, path, parameters, {}};
    section.parameters.kind = ConfigNode::Kind::map;
    section.parameters.items.clear();
    const FilePlace place{file_, parameters.mark.line, parameters.mark.column, path};
    if (!parameters.is_map() && !says_nothing) {
      section.fault =
          FileError(place, what_is(parameters), "a map of parameters, further to the right");
    }
    try {
      for (const ConfigNode& item : parameters.items) {
        if (parameters.is_map()) insert_dotted(place, section.parameters, item.key, item);
      }
    } catch (const FileError& error) {
      section.fault = error;
    }
    const auto same = std::find_if(found_.begin(), found_.end(),
                                   [&](const auto& each) { return each.name == name; });
    if (same == found_.end()) {
      found_.push_back(std::move(section));
    } else {  // the same section, written in two ways: /arm and arm
      mark_inherited(section.parameters, path);
      std::vector<Replacement> ignored;
      replace_entries(same->parameters, section.parameters, same->path, ignored);
      if (!same->fault) same->fault = section.fault;
    }
  }

  std::string file_;
  std::vector<std::string>* notes_;
  std::vector<WrittenSection> found_{};
};

}  // namespace articula::detail
