// SPDX-License-Identifier: Apache-2.0
/// @file Merges maps of a configuration.
#pragma once

#include "articula/config/yaml/document.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

[[nodiscard]] inline bool same_value(const ConfigNode& a, const ConfigNode& b) noexcept {
  return a.kind == b.kind && a.quoted == b.quoted && a.text == b.text &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(),
                    [](const ConfigNode& x, const ConfigNode& y) {
                      return x.key == y.key && same_value(x, y);
                    });
}

/// Marks the entries of a map, and all below them, as inherited from another section.
inline void mark_inherited(ConfigNode& map) {
  for (ConfigNode& item : map.items) {
    item.inherited = true;
    mark_inherited(item);
  }
}

/// Adds entries of one map that another one lacks. Maps in both are merged.
inline void add_missing(ConfigNode& map, const ConfigNode& additions) {
  for (const ConfigNode& item : additions.items) {
    ConfigNode* same = map.find(item.key);
    if (same == nullptr) {
      map.items.push_back(item);
    } else if (same->is_map() && item.is_map()) {
      add_missing(*same, item);
    }
  }
}

/// Replaces entries of a map by inherited ones, and adds those that it lacks. Maps in both are
/// merged.
/// @param notes  receives a line on each value that has changed
inline void replace_entries(ConfigNode& map, const ConfigNode& replacements,
                            std::vector<std::string>& notes) {
  for (const ConfigNode& item : replacements.items) {
    ConfigNode* same = map.find(item.key);
    if (same == nullptr) {
      map.items.push_back(item);
      continue;
    }
    if (same->is_map() && item.is_map()) {
      replace_entries(*same, item, notes);
      continue;
    }
    if (!same_value(*same, item)) {
      notes.push_back(same->key_place.text() + "not used: " + item.place.key + " in line " +
                      std::to_string(item.key_place.line) + " comes later and counts, as in ROS 2");
    }
    *same = item;
  }
}

/// Inserts a value into a map. Dots in the key are levels: ROS 2 reads the key `gravity.z` as `z`
/// in the map `gravity`.
/// @param place  of the map
/// @throws FileError if the map already has a value there
inline void insert_dotted(const FilePlace& place, ConfigNode& map, std::string_view key,
                          const ConfigNode& item, std::size_t depth = 0) {
  if (depth > ConfigBuilder::deepest) {
    throw FileError(place, "the key '" + shown(item.key) + "' has too many dots", "fewer");
  }
  const std::size_t dot = key.find('.');
  const bool inner = dot != std::string_view::npos;
  const std::string_view first = key.substr(0, dot);
  ConfigNode* same = map.find(first);
  const bool is_new = same == nullptr;
  if (is_new) {
    map.items.push_back({.kind = ConfigNode::Kind::map,
                         .key = std::string(first),
                         .place = item.place,
                         .key_place = item.key_place,
                         .value_names = item.value_names});
    same = &map.items.back();
    same->place.key = same->key_place.key = path_in(map, first);
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
    FilePlace second = item.key_place;
    second.key = place.key;
    throw FileError(
        second, "'" + shown(item.key) + "' is also in line " + std::to_string(same->key_place.line),
        "every key once");
  }
}

}  // namespace articula::detail
