// SPDX-License-Identifier: Apache-2.0
/// @file A YAML document as a tree of nodes, converted to the types that callers expect.
#pragma once

#include "articula/config/yaml/scalar.hpp"
#include "articula/core/finite.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/number_hint.hpp"
#include "articula/text/placeholder.hpp"
#include "articula/text/similar_word.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// A scalar, list or map, or nothing, with its position in the file. Maps keep the file's order.
/// Each conversion throws a FileError if the value has another type or is out of range.
struct ConfigNode {
  enum class Kind : unsigned char { nothing, scalar, list, map };

  Kind kind = Kind::nothing;
  bool quoted = false;              ///< a scalar in quotation marks: always text
  bool inherited = false;           ///< it comes from a section with wildcards
  std::string text{};               ///< of a scalar
  std::string key{};                ///< in a map
  FilePlace place{};                ///< of the value
  FilePlace key_place{};            ///< of the key
  std::string value_names{};        ///< values of the source, if a placeholder here has none
  std::vector<ConfigNode> items{};  ///< of a list or map

  [[nodiscard]] bool is_map() const noexcept { return kind == Kind::map; }
  [[nodiscard]] bool is_list() const noexcept { return kind == Kind::list; }

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

  /// The node as a message names it.
  [[nodiscard]] std::string named() const {
    if (is_map()) return "a map";
    if (is_list()) return "a list of " + std::to_string(items.size());
    if (kind == Kind::nothing) return "nothing";
    if (has_placeholder(text)) return placeholder_text(placeholder_in(text));
    if (quoted) return "the quoted text '" + shown(text) + "'";
    const ParsedNumber number = parse_number(text);
    if (!number.is_number) return "the word " + quoted_text(text);
    return "the number " + shown(text) +
           (number.in_range ? "" : ", which is beyond the range of double");
  }
  [[noreturn]] void refuse(const std::string& reason, const std::string& expected) const {
    throw FileError(place, reason, expected);
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    refuse(named(), expected + value_hint(text, value_names));
  }

  /// A finite number.
  [[nodiscard]] double number() const {
    const double value = number_or_infinity();
    if (!is_finite(value)) refuse("a finite number");
    return value;
  }
  [[nodiscard]] double number_or_infinity() const {
    const ParsedNumber number = parsed();
    if (!number.in_range || std::isnan(number.value)) refuse("a number" + hint());
    return number.value;
  }
  [[nodiscard]] double not_negative() const {
    const double value = number();
    if (value < 0) refuse("a number >= 0");
    return value;
  }
  [[nodiscard]] double positive() const {
    const double value = number();
    if (value <= 0) refuse("a number > 0");
    return value;
  }
  [[nodiscard]] int integer(int lowest, int highest) const {
    const ParsedNumber number = parsed();
    const bool in_range = number.in_range && number.value >= lowest && number.value <= highest;
    if (!in_range || number.value != std::floor(number.value)) {
      refuse("a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest) +
             hint());
    }
    return static_cast<int>(number.value);
  }
  [[nodiscard]] bool truth() const {
    const auto value = is_plain() ? as_truth(text) : std::nullopt;
    if (!value) refuse("true or false");
    return *value;
  }
  /// A text. Without quotation marks it must be neither a number nor a truth value.
  [[nodiscard]] const std::string& word() const {
    const bool is_word =
        !parse_number(text).is_number && !as_truth(text) && odd_character_in(text).empty();
    if (text.empty() || !(quoted || is_word)) refuse("a name");
    return text;
  }
  /// A word without placeholders: the name of a link or joint.
  [[nodiscard]] const std::string& name() const {
    if (has_placeholder(word())) refuse("a name");
    return text;
  }
  /// The index of this word among some words.
  [[nodiscard]] std::size_t index_in(const std::vector<std::string>& words) const {
    for (std::size_t k = 0; k < words.size(); ++k) {
      if (kind == Kind::scalar && text == words[k]) return k;
    }
    refuse(named(), one_of_words(text, words));
  }
  [[nodiscard]] const std::vector<ConfigNode>& list() const {
    if (!is_list()) {
      const bool has_commas = is_plain() && text.find(',') != std::string::npos;
      refuse(has_commas ? "a list in brackets, [" + shown(text) + "]" : "a list");
    }
    return items;
  }

 private:
  [[nodiscard]] bool is_plain() const noexcept { return kind == Kind::scalar && !quoted; }
  [[nodiscard]] ParsedNumber parsed() const {
    return is_plain() ? parse_number(text) : ParsedNumber{};
  }
  /// How to correct a value that should be a number.
  [[nodiscard]] std::string hint() const {
    const bool is_number = parse_number(text).is_number;
    if (quoted && is_number) return " without quotes";
    if (!is_plain() || is_number) return "";
    const bool is_infinity = is_one_of(text, {"inf", "infinity", "-inf", "-infinity"});
    return is_infinity ? "; infinity is .inf" : number_hint(text);
  }
};

/// The keys from the top to a value of a map.
[[nodiscard]] inline std::string path_in(const ConfigNode& map, std::string_view key) {
  return (map.place.key.empty() ? "" : map.place.key + ".") + shown(key);
}

/// Sets the file and the keys from the top in the positions of a tree.
inline void set_paths(ConfigNode& node, const std::string& file, const std::string& path) {
  node.place.file = node.key_place.file = file;
  node.place.key = node.key_place.key = path;
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    ConfigNode& item = node.items[k];
    set_paths(item, file,
              node.is_list() ? path + "[" + std::to_string(k) + "]" : path_in(node, item.key));
  }
}

[[nodiscard]] inline std::size_t node_count(const ConfigNode& node) noexcept {
  std::size_t count = 1;
  for (const ConfigNode& item : node.items) count += node_count(item);
  return count;
}

}  // namespace articula::detail
