// SPDX-License-Identifier: Apache-2.0
/// @file Where in a file the parameters of a controller stand, in the layouts of ROS 1 and ROS 2.
#pragma once

#include "articula/config/document.hpp"
#include "articula/config/reader.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
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
};

/// The sections of a file, and the place of the file's top.
struct ConfigSections {
  std::string file{};
  std::vector<ConfigSection> sections{};
  std::vector<std::string> notes{};
};

inline constexpr std::string_view ros_parameters = "ros__parameters";

/// Entries of `weak` that `strong` does not have are added to it; maps are merged. Both are maps.
inline void merge_into(ConfigNode& strong, const ConfigNode& weak) {
  for (const ConfigNode& item : weak.items) {
    const auto same = std::find_if(strong.items.begin(), strong.items.end(),
                                   [&](const ConfigNode& mine) { return mine.key == item.key; });
    if (same == strong.items.end()) {
      strong.items.push_back(item);
    } else if (same->is_map() && item.is_map()) {
      merge_into(*same, item);
    }
  }
}

/// Puts a value into a map under a key, in which dots go down: ROS 2 takes the key `gravity.z` for
/// `z` in the map `gravity`.
/// @throws ConfigError if a value is given both ways
inline void insert_dotted(const ConfigPlace& place, ConfigNode& map, std::string_view key,
                          const ConfigNode& item, std::size_t depth = 0) {
  if (depth > ConfigBuilder::deepest) {
    throw ConfigError(place, "the key '" + shown(item.key) + "' has too many dots", "fewer");
  }
  const std::size_t dot = key.find('.');
  const bool inner = dot != std::string_view::npos;
  const std::string_view first = key.substr(0, dot);
  auto same = std::find_if(map.items.begin(), map.items.end(),
                           [&](const ConfigNode& node) { return node.key == first; });
  const bool is_new = same == map.items.end();
  if (is_new) {
    map.items.push_back({.kind = ConfigNode::Kind::map,
                         .key = std::string(first),
                         .mark = item.mark,
                         .key_mark = item.key_mark});
    same = map.items.end() - 1;
  }
  if (same->is_map() && inner) {
    insert_dotted(place, *same, key.substr(dot + 1), item, depth + 1);
  } else if (same->is_map() && item.is_map()) {
    for (const ConfigNode& part : item.items) {
      insert_dotted(place, *same, part.key, part, depth + 1);
    }
  } else if (is_new) {
    *same = item;
    same->key = first;
  } else {
    throw ConfigError(
        {place.file, item.key_mark.line, item.key_mark.column, place.key},
        "'" + shown(item.key) + "' is also in line " + std::to_string(same->key_mark.line),
        "every key once");
  }
}

/// Finds the sections of a file.
class SectionFinder {
 public:
  explicit SectionFinder(const ConfigSource& source)
      : root_(read_document(source)), found_{.file = source.name()} {
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
        found_.notes.push_back(found_.file + ":" + std::to_string(item.key_mark.line) + ": " +
                               here + ": not used, it belongs to no controller");
      } else if (const ConfigNode* parameters = item.find(ros_parameters)) {
        if (!parameters->is_map()) {
          ConfigValue(found_.file, *parameters, here + "." + std::string(ros_parameters))
              .refuse("a map of parameters");
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
      wildcards_.push_back(std::move(nested));
    } else {
      found_.sections.push_back({last, path, joined(group, first, "/"), "", std::move(nested)});
    }
  }

  /// What stands under /** is every controller's, but weaker than what is its own.
  void apply_wildcards() {
    if (found_.sections.empty() && !wildcards_.empty()) {
      found_.sections.push_back({.path = "/**", .parameters = wildcards_.front()});
    }
    std::size_t nodes = 0;
    for (const ConfigNode& wildcard : wildcards_) {
      nodes += node_count(wildcard) * found_.sections.size();
      if (nodes > ConfigBuilder::most_nodes) {
        throw ConfigError({.file = found_.file}, "it is too large, wildcards included",
                          "at most " + std::to_string(ConfigBuilder::most_nodes) + " values");
      }
      for (ConfigSection& section : found_.sections) merge_into(section.parameters, wildcard);
    }
  }

  /// A controller's type stands with its parameters in ROS 1, with the controller manager in ROS 2.
  void find_types() {
    const auto manager =
        std::find_if(found_.sections.begin(), found_.sections.end(),
                     [](const auto& section) { return section.name == "controller_manager"; });
    for (ConfigSection& section : found_.sections) {
      const ConfigNode* type = section.parameters.find("type");
      const ConfigNode* entry = type == nullptr && manager != found_.sections.end()
                                    ? manager->parameters.find(section.name)
                                    : nullptr;
      if (entry != nullptr) type = entry->find("type");
      if (type != nullptr && type->kind == ConfigNode::Kind::scalar) section.type = type->text;
    }
  }

  ConfigNode root_;
  ConfigSections found_;
  std::vector<ConfigNode> wildcards_{};
};

/// All sections of a file.
/// @throws ConfigError if it is no YAML, or not of the kind that has sections
[[nodiscard]] inline ConfigSections find_sections(const ConfigSource& source) {
  return SectionFinder(source).take();
}

/// Those sections of a file that are meant.
/// @param name      of a controller, a namespace or a type of controllers; empty: any
/// @param relevant  without a name, sections for which this is false are left out
/// @param what      is looked for, for the message
/// @throws ConfigError if there is none
[[nodiscard]] inline std::vector<ConfigSection> chosen_sections(
    const ConfigSections& all, std::string_view name,
    const std::function<bool(const ConfigSection&)>& relevant, const std::string& what) {
  while (name.starts_with('/')) name.remove_prefix(1);
  std::vector<std::string> names;
  std::vector<ConfigSection> exact, chosen;
  for (const ConfigSection& section : all.sections) {
    if (section.name == "controller_manager") continue;
    const std::string full =
        section.group.empty() ? section.name : section.group + "/" + section.name;
    names.push_back(full);
    if (!name.empty() && (section.name == name || full == name)) exact.push_back(section);
    const bool within = name.empty() || section.type == name || section.group == name ||
                        section.group.starts_with(std::string(name) + "/");
    if (within && relevant(section)) chosen.push_back(section);
  }
  if (!exact.empty()) return exact;
  // A file that is nothing but parameters is anybody's.
  if (chosen.empty() && all.sections.size() == 1 && all.sections[0].name.empty()) {
    return all.sections;
  }
  if (!chosen.empty()) return chosen;
  if (name.empty()) {
    throw ConfigError({.file = all.file}, "there is no " + what + " in it", "one");
  }
  throw ConfigError({.file = all.file},
                    "there is no " + what + " called '" + shown(name) + "' in it",
                    names.empty() ? "one" : choice_text(names, name));
}

}  // namespace articula::detail
