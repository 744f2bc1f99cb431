// SPDX-License-Identifier: Apache-2.0
/// @file Where in a file the parameters of a controller stand, in the layouts of ROS 1 and ROS 2.
#pragma once

#include "articula/config/document.hpp"
#include "articula/config/merge.hpp"
#include "articula/config/reader.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// The parameters of one controller (or of the controller manager) as they stand in a file.
struct ConfigSection {
  std::string name{};   ///< of the controller; empty where the file is nothing but its parameters
  std::string path{};   ///< the keys from the top
  std::string group{};  ///< the namespaces around it, with slashes
  std::string type{};   ///< that the section or the controller manager gives it; may be empty
  ConfigNode parameters{};

  [[nodiscard]] std::string full_name() const { return group.empty() ? name : group + "/" + name; }
  /// Where it begins, for messages.
  [[nodiscard]] int line() const noexcept { return parameters.key_mark.line; }
};

/// The sections of a file, and the place of the file's top.
struct ConfigSections {
  std::string file{};
  std::vector<ConfigSection> sections{};
  std::vector<std::string> notes{};
};

inline constexpr std::string_view ros_parameters = "ros__parameters";

/// Finds the sections of a file.
class SectionFinder {
 public:
  explicit SectionFinder(const ConfigSource& source)
      : root_(read_document(source)), found_{.file = source.name()} {
    check_spelling(root_, "");
    if (is_namespace(root_) || is_of_maps(root_)) {
      search(root_, "", "");
    } else {
      add("", "", "", root_);
    }
    apply_wildcards();
    find_types();
  }

  [[nodiscard]] ConfigSections take() { return std::move(found_); }

 private:
  /// Plugins' names have a slash: this tells the type of a controller from that of a signal.
  [[nodiscard]] static bool has_type(const ConfigNode& node) {
    const ConfigNode* type = node.find("type");
    return type != nullptr && type->text.find('/') != std::string::npos;
  }
  /// A slip here would make other parameters of a file, and no message would name the reason.
  void check_spelling(const ConfigNode& map, const std::string& path) const {
    for (const ConfigNode& item : map.items) {
      const std::string here = joined(path, shown(item.key), ".");
      const std::size_t apart = distance_of(ros_parameters, item.key).value_or(3);
      const ConfigPlace place{found_.file, item.key_mark.line, item.key_mark.column, here};
      const std::string expected = "'" + std::string(ros_parameters) + "'";
      if (apart <= 2 && item.key != ros_parameters) {
        throw ConfigError(place, "unknown key '" + shown(item.key) + "'", expected);
      }
      if (apart == 0 && path.empty()) {
        throw ConfigError(place, expected + " at the top", "it below a controller's name, or /**");
      }
      check_spelling(item, here);
    }
  }
  [[nodiscard]] static bool is_namespace(const ConfigNode& map) {
    return std::any_of(map.items.begin(), map.items.end(), [](const ConfigNode& item) {
      return item.is_map() && (item.find(ros_parameters) != nullptr || has_type(item) ||
                               item.key == "controller_manager" || is_namespace(item));
    });
  }
  [[nodiscard]] static bool is_of_maps(const ConfigNode& map) {
    const std::vector<std::string> parameters = {"pid",   "gains",   "constraints",
                                                 "chain", "gravity", "waveforms"};
    return std::all_of(map.items.begin(), map.items.end(), [&](const ConfigNode& item) {
      return item.is_map() &&
             std::find(parameters.begin(), parameters.end(), item.key) == parameters.end();
    });
  }
  [[nodiscard]] static std::string joined(const std::string& a, const std::string& b,
                                          const char* separator) {
    return a.empty() || b.empty() ? a + b : a + separator + b;
  }

  void search(const ConfigNode& map, const std::string& group, const std::string& path) {
    for (const ConfigNode& item : map.items) {
      const std::string here = joined(path, shown(item.key), ".");
      std::string name = item.key;  // without the slashes at its ends
      while (name.starts_with('/')) name.erase(0, 1);
      while (name.ends_with('/')) name.pop_back();
      if (!item.is_map()) {
        note(item, here, "not used, it belongs to no controller");
      } else if (const ConfigNode* parameters = item.find(ros_parameters)) {
        if (!parameters->is_map()) {
          ConfigValue(found_.file, *parameters, here + "." + std::string(ros_parameters))
              .refuse("a map of parameters, further to the right");
        }
        add(name, group, joined(here, std::string(ros_parameters), "."), *parameters);
        ConfigNode others = item;
        std::erase_if(others.items, [](const auto& node) { return node.key == ros_parameters; });
        search(others, joined(group, name, "/"), here);
      } else if (item.key != "controller_manager" && !has_type(item) &&
                 (is_namespace(item) || is_of_maps(item))) {
        search(item, joined(group, name, "/"), here);
      } else {
        add(name, group, here, item);
      }
    }
  }

  void add(const std::string& name, const std::string& group, const std::string& path,
           const ConfigNode& parameters) {
    const std::size_t slash = name.rfind('/');
    const std::string last = slash == std::string::npos ? name : name.substr(slash + 1);
    const std::string first = slash == std::string::npos ? "" : name.substr(0, slash);
    ConfigNode nested = parameters;
    nested.items.clear();
    const ConfigPlace place{found_.file, parameters.mark.line, parameters.mark.column, path};
    for (const ConfigNode& item : parameters.items) insert_dotted(place, nested, item.key, item);
    if (last == "**" || last == "*") {
      // The nearer to the controllers, the earlier, since what is there first is stronger.
      const std::string within = joined(group, first, "/");
      const auto next = std::find_if(wildcards_.begin(), wildcards_.end(), [&](const auto& each) {
        return each.group.size() < within.size();
      });
      wildcards_.insert(next, {within, last == "**", path, std::move(nested)});
    } else {
      found_.sections.push_back({last, path, joined(group, first, "/"), "", std::move(nested)});
    }
  }

  /// What stands under /** is every controller's and under /ns/** that of those in ns, but weaker
  /// than what is nearer to a controller.
  void apply_wildcards() {
    if (found_.sections.empty() && !wildcards_.empty()) {
      Wildcard& first = wildcards_.front();
      found_.sections.push_back(
          {.path = first.path, .group = first.group, .parameters = std::move(first.parameters)});
      wildcards_.erase(wildcards_.begin());
    }
    std::size_t nodes = 0;
    for (const Wildcard& wildcard : wildcards_) {
      bool used = false;
      for (ConfigSection& section : found_.sections) {
        if (!wildcard.covers(section.group)) continue;
        used = true;
        nodes += node_count(wildcard.parameters);
        if (nodes > ConfigBuilder::most_nodes) {
          throw ConfigError({.file = found_.file}, "it is too large, wildcards included",
                            "at most " + std::to_string(ConfigBuilder::most_nodes) + " values");
        }
        merge_into(section.parameters, wildcard.parameters, wildcard.path);
      }
      if (!used)
        note(wildcard.parameters, wildcard.path, "not used, no section is in this namespace");
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
      const ConfigNode* manager = type == nullptr ? manager_of(section) : nullptr;
      const ConfigNode* entry = manager != nullptr ? manager->find(section.name) : nullptr;
      if (entry != nullptr) type = entry->find("type");
      if (type != nullptr && type->kind == ConfigNode::Kind::scalar) section.type = type->text;
    }
  }

  void note(const ConfigNode& node, const std::string& path, const std::string& text) {
    found_.notes.push_back(found_.file + ":" + std::to_string(node.key_mark.line) + ": " + path +
                           ": " + text);
  }

  /// Parameters of all sections in a namespace.
  struct Wildcard {
    std::string group;  ///< the namespace
    bool below;         ///< **: namespaces inside of it as well
    std::string path;
    ConfigNode parameters;

    [[nodiscard]] bool covers(const std::string& other) const {
      return other == group || (below && (group.empty() || other.starts_with(group + "/")));
    }
  };

  ConfigNode root_;
  ConfigSections found_;
  std::vector<Wildcard> wildcards_{};
};

/// All sections of a file.
/// @throws ConfigError if it is no YAML, or not of the kind that has sections
[[nodiscard]] inline ConfigSections find_sections(const ConfigSource& source) {
  return SectionFinder(source).take();
}

}  // namespace articula::detail
