// SPDX-License-Identifier: Apache-2.0
/// @file A YAML document as a tree of nodes with their places in the file.
#pragma once

#include "articula/text/file_error.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
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
  bool quoted = false;     ///< a scalar in quotation marks: always text
  std::string text{};      ///< of a scalar
  std::string key{};       ///< in a map
  std::string origin{};    ///< keys from the top, if the node comes from a section with wildcards
  bool inherited = false;  ///< it comes from such a section
  ConfigMark mark{};       ///< of the value
  ConfigMark key_mark{};   ///< of the key
  std::string value_names{};        ///< values of the source, if a placeholder here has none
  std::vector<ConfigNode> items{};  ///< of a list or map

  [[nodiscard]] bool is_map() const noexcept { return kind == Kind::map; }
  [[nodiscard]] bool is_list() const noexcept { return kind == Kind::list; }
  [[nodiscard]] bool is_inherited() const noexcept { return !origin.empty(); }

  /// The value of a key; none if there is no such key, or this is no map.
  [[nodiscard]] const ConfigNode* find(std::string_view wanted) const noexcept {
    if (!is_map()) return nullptr;
    const auto found = std::find_if(items.begin(), items.end(),
                                    [&](const ConfigNode& item) { return item.key == wanted; });
    return found == items.end() ? nullptr : &*found;
  }
  [[nodiscard]] ConfigNode* find(std::string_view wanted) noexcept {
    return const_cast<ConfigNode*>(static_cast<const ConfigNode*>(this)->find(wanted));
  }
  /// True if this is a map with one of some keys.
  [[nodiscard]] bool has_any(std::initializer_list<std::string_view> keys) const noexcept {
    return std::any_of(keys.begin(), keys.end(),
                       [&](std::string_view wanted) { return find(wanted) != nullptr; });
  }

  /// The place of the key.
  /// @param path  keys from the top
  [[nodiscard]] FilePlace key_place(const std::string& file, const std::string& path) const {
    return {file, key_mark.line, key_mark.column, path};
  }
};

/// The number of nodes in a tree.
[[nodiscard]] inline std::size_t node_count(const ConfigNode& node) noexcept {
  std::size_t count = 1;
  for (const ConfigNode& item : node.items) count += node_count(item);
  return count;
}

/// True if two trees have the same values.
[[nodiscard]] inline bool same_value(const ConfigNode& a, const ConfigNode& b) noexcept {
  return a.kind == b.kind && a.quoted == b.quoted && a.text == b.text &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(),
                    [](const ConfigNode& x, const ConfigNode& y) {
                      return x.key == y.key && same_value(x, y);
                    });
}

/// The number of levels of a tree.
[[nodiscard]] inline std::size_t node_height(const ConfigNode& node) noexcept {
  std::size_t height = 0;
  for (const ConfigNode& item : node.items) height = std::max(height, node_height(item));
  return height + 1;
}

}  // namespace articula::detail
