// SPDX-License-Identifier: Apache-2.0
/// @file Puts maps of a configuration together.
#pragma once

#include "articula/config/yaml/document.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Says of a map's entries, and of all below them, that they come from another section.
inline void mark_inherited(ConfigNode& map, const std::string& path) {
  for (ConfigNode& item : map.items) {
    item.from = path + "." + shown(item.key);
    item.inherited = true;
    mark_inherited(item, item.from);
  }
}

/// Entries of `weak` that `strong` does not have are added to it; maps are merged. Both are maps.
inline void add_missing(ConfigNode& strong, const ConfigNode& weak) {
  for (const ConfigNode& item : weak.items) {
    const auto same = std::find_if(strong.items.begin(), strong.items.end(),
                                   [&](const ConfigNode& mine) { return mine.key == item.key; });
    if (same == strong.items.end()) {
      strong.items.push_back(item);
    } else if (same->is_map() && item.is_map()) {
      add_missing(*same, item);
    }
  }
}

/// An entry that has become another one.
struct Replacement {
  std::string path;  ///< of what it was
  ConfigMark mark;   ///< likewise, of its key
  std::string by;    ///< the path of what it is
  int line;          ///< likewise
};

/// Entries of `strong`, which are inherited, take the place of those of `weak`; maps are merged.
/// Both are maps.
/// @param path      of `weak`
/// @param replaced  receives the entries that are others now
inline void replace_entries(ConfigNode& weak, const ConfigNode& strong, const std::string& path,
                            std::vector<Replacement>& replaced) {
  for (const ConfigNode& item : strong.items) {
    const auto same = std::find_if(weak.items.begin(), weak.items.end(),
                                   [&](const ConfigNode& mine) { return mine.key == item.key; });
    if (same == weak.items.end()) {
      weak.items.push_back(item);
      continue;
    }
    const std::string here = same->from.empty() ? path + "." + shown(item.key) : same->from;
    if (same->is_map() && item.is_map()) {
      replace_entries(*same, item, here, replaced);
      continue;
    }
    if (!same_value(*same, item)) {
      replaced.push_back({here, same->key_mark, item.from, item.key_mark.line});
    }
    *same = item;
  }
}

/// Puts a value into a map under a key, in which dots go down: ROS 2 takes the key `gravity.z` for
/// `z` in the map `gravity`.
/// @throws FileError if a value is given both ways
inline void insert_dotted(const FilePlace& place, ConfigNode& map, std::string_view key,
                          const ConfigNode& item, std::size_t depth = 0) {
  if (depth > ConfigBuilder::deepest) {
    throw FileError(place, "the key '" + shown(item.key) + "' has too many dots", "fewer");
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
                         .key_mark = item.key_mark,
                         .given = item.given});
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
    throw FileError(
        {place.file, item.key_mark.line, item.key_mark.column, place.key},
        "'" + shown(item.key) + "' is also in line " + std::to_string(same->key_mark.line),
        "every key once");
  }
}

}  // namespace articula::detail
