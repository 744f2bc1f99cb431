// SPDX-License-Identifier: Apache-2.0
/// @file What a YAML file says, as a tree in which everything knows its place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Line and column in a file, both from 1.
struct ConfigMark {
  int line = 1;
  int column = 1;
};

/// A scalar, list or map, or nothing. Maps keep the order of the file.
struct ConfigNode {
  enum class Kind : unsigned char { nothing, scalar, list, map };

  Kind kind = Kind::nothing;
  bool quoted = false;     ///< a scalar that is text whatever it looks like
  std::string text{};      ///< of a scalar
  std::string key{};       ///< in a map
  std::string from{};      ///< the keys from the top where it comes from another section, /** or so
  bool inherited = false;  ///< likewise: something that the section may not know
  ConfigMark mark{};
  ConfigMark key_mark{};
  std::string given{};  ///< values that were given, if text or key has a placeholder without one
  std::vector<ConfigNode> items{};  ///< of a list or map

  [[nodiscard]] bool is_map() const noexcept { return kind == Kind::map; }
  [[nodiscard]] bool is_list() const noexcept { return kind == Kind::list; }

  /// The value under a key; none if there is none, or this is no map.
  [[nodiscard]] const ConfigNode* find(std::string_view wanted) const noexcept {
    if (!is_map()) return nullptr;
    const auto found = std::find_if(items.begin(), items.end(),
                                    [&](const ConfigNode& item) { return item.key == wanted; });
    return found == items.end() ? nullptr : &*found;
  }
};

/// How many nodes a tree has.
[[nodiscard]] inline std::size_t node_count(const ConfigNode& node) noexcept {
  std::size_t count = 1;
  for (const ConfigNode& item : node.items) count += node_count(item);
  return count;
}

/// True if two trees say the same.
[[nodiscard]] inline bool same_value(const ConfigNode& a, const ConfigNode& b) noexcept {
  return a.kind == b.kind && a.quoted == b.quoted && a.text == b.text &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(),
                    [](const ConfigNode& x, const ConfigNode& y) {
                      return x.key == y.key && same_value(x, y);
                    });
}

/// How many levels a tree has.
[[nodiscard]] inline std::size_t node_height(const ConfigNode& node) noexcept {
  std::size_t height = 0;
  for (const ConfigNode& item : node.items) height = std::max(height, node_height(item));
  return height + 1;
}

}  // namespace articula::detail
