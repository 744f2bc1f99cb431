// SPDX-License-Identifier: Apache-2.0
/// @file Takes values out of a configuration, and says what is wrong with them.
#pragma once

#include "articula/config/error.hpp"
#include "articula/config/node.hpp"
#include "articula/config/scalar.hpp"
#include "articula/core/finite.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// A value of a configuration and its place. It refers to the tree, which must live on.
class ConfigValue {
 public:
  ConfigValue(std::string file, const ConfigNode& node, std::string path)
      : file_(std::move(file)), node_(&node), path_(std::move(path)) {}

  [[nodiscard]] const ConfigNode& node() const noexcept { return *node_; }
  [[nodiscard]] ConfigPlace place() const {
    return {file_, node_->mark.line, node_->mark.column, path_};
  }
  [[noreturn]] void refuse(const std::string& reason, const std::string& expected) const {
    throw ConfigError(place(), reason, expected);
  }
  /// @throws ConfigError: what stands there, and what should
  [[noreturn]] void refuse(const std::string& expected) const { refuse(what_is(*node_), expected); }

  /// A finite number.
  [[nodiscard]] double number() const {
    const double value = number_or_infinity();
    if (!is_finite(value)) refuse("a finite number");
    return value;
  }
  /// A number, or infinity in either direction.
  [[nodiscard]] double number_or_infinity() const {
    const auto value = plain() ? as_number(node_->text) : std::nullopt;
    if (!value || std::isnan(*value)) refuse("a number");
    return *value;
  }
  /// A finite number >= 0.
  [[nodiscard]] double not_negative() const {
    const double value = number();
    if (value < 0) refuse("a number >= 0");
    return value;
  }
  /// A finite number > 0.
  [[nodiscard]] double positive() const {
    const double value = number();
    if (value <= 0) refuse("a number > 0");
    return value;
  }
  /// A whole number.
  [[nodiscard]] int integer(int lowest, int highest) const {
    const std::string expected =
        "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
    const auto value = plain() ? as_number(node_->text) : std::nullopt;
    if (!value || !(*value >= lowest && *value <= highest) || *value != std::floor(*value)) {
      refuse(expected);
    }
    return static_cast<int>(*value);
  }
  [[nodiscard]] bool truth() const {
    const auto value = plain() ? as_truth(node_->text) : std::nullopt;
    if (!value) refuse("true or false");
    return *value;
  }
  /// A name: text that is no number and no truth value, unless it is quoted.
  [[nodiscard]] std::string word() const {
    const bool good =
        node_->kind == ConfigNode::Kind::scalar && !node_->text.empty() &&
        (node_->quoted || (!parse_number(node_->text).is_number && !as_truth(node_->text)));
    if (!good) refuse("a name");
    return node_->text;
  }
  /// One of some words; the index of it.
  [[nodiscard]] std::size_t one_of(const std::vector<std::string>& words) const {
    for (std::size_t k = 0; k < words.size(); ++k) {
      if (node_->kind == ConfigNode::Kind::scalar && node_->text == words[k]) return k;
    }
    refuse(what_is(*node_), choice_text(words, node_->text));
  }
  [[nodiscard]] std::vector<ConfigValue> list() const {
    if (!node_->is_list()) refuse("a list");
    std::vector<ConfigValue> values;
    for (std::size_t k = 0; k < node_->items.size(); ++k) {
      values.emplace_back(file_, node_->items[k], path_ + "[" + std::to_string(k) + "]");
    }
    return values;
  }
  /// The value under a key of this map.
  [[nodiscard]] ConfigValue at(const ConfigNode& item) const {
    if (!item.from.empty()) return {file_, item, item.from};
    return {file_, item, (path_.empty() ? "" : path_ + ".") + shown(item.key)};
  }

 private:
  [[nodiscard]] bool plain() const noexcept {
    return node_->kind == ConfigNode::Kind::scalar && !node_->quoted;
  }

  std::string file_;
  const ConfigNode* node_;
  std::string path_;
};

/// A map of a configuration. It remembers what was asked for: what is left over in the end is
/// unknown.
class ConfigMap {
 public:
  /// @param notes  receives what is known and not used
  /// @throws ConfigError if the value is no map
  ConfigMap(ConfigValue value, std::vector<std::string>& notes)
      : value_(std::move(value)), notes_(&notes) {
    if (!value_.node().is_map()) value_.refuse("a map");
  }

  [[nodiscard]] const ConfigValue& value() const noexcept { return value_; }

  /// The value under a key, if there is one.
  [[nodiscard]] std::optional<ConfigValue> find(std::string_view key) {
    if (!knows(key)) known_.emplace_back(key);
    const ConfigNode* item = value_.node().find(key);
    if (item == nullptr) return {};
    ++found_;
    return value_.at(*item);
  }
  /// The value under a key that must be there; if it is not, finish() throws. That may wait: what
  /// seems to be missing may be misspelt.
  [[nodiscard]] std::optional<ConfigValue> expect(std::string_view key) {
    auto found = find(key);
    if (!found) missing_.emplace_back(key);
    return found;
  }
  /// The map under a key, if there is one.
  [[nodiscard]] std::optional<ConfigMap> find_map(std::string_view key) {
    const auto found = find(key);
    if (!found) return {};
    return ConfigMap(*found, *notes_);
  }

  /// How many keys were asked for and there.
  [[nodiscard]] std::size_t found() const noexcept { return found_; }
  /// True if a key was asked for.
  [[nodiscard]] bool knows(std::string_view key) const {
    return std::find(known_.begin(), known_.end(), key) != known_.end();
  }
  /// True if a key is near to one that was asked for.
  [[nodiscard]] bool nearly_knows(std::string_view key) const {
    return nearest_name(known_, key) != nullptr;
  }
  /// True if there are keys that nobody asked for, what is inherited aside.
  [[nodiscard]] bool has_unknown() const { return !unknown().empty(); }

  /// Says something about a value.
  void note(const ConfigValue& at, std::string_view text) const {
    const ConfigPlace place = at.place();
    notes_->push_back(place.file + ":" + std::to_string(place.line) + ": " + place.key + ": " +
                      std::string(text));
  }

  /// @throws ConfigError if the map has a key that nobody asked for, or lacks one that it must have
  void finish() const {
    constexpr std::size_t listed = 3, tried = 16;
    for (const ConfigNode& item : value_.node().items) {
      if (item.inherited && !knows(item.key)) note(value_.at(item), "not used here");
    }
    const auto others = unknown();
    const ConfigNode* wrong = others.empty() ? nullptr : others.front();
    if (!missing_.empty()) {
      // What is almost a key is a slip, and the likely reason why another one is missing.
      const auto last =
          others.begin() + static_cast<std::ptrdiff_t>(std::min(others.size(), tried));
      const auto slip = std::find_if(
          others.begin(), last, [&](const ConfigNode* item) { return nearly_knows(item->key); });
      if (slip == last) value_.refuse("the key '" + missing_.front() + "' is missing", "it here");
      wrong = *slip;
    }
    if (wrong == nullptr) return;
    ConfigPlace place = value_.at(*wrong).place();
    place.line = wrong->key_mark.line;
    place.column = wrong->key_mark.column;
    throw ConfigError(place, "unknown key '" + shown(wrong->key) + "'",
                      choice_text(known_, wrong->key, listed));
  }

 private:
  [[nodiscard]] std::vector<const ConfigNode*> unknown() const {
    std::vector<const ConfigNode*> items;
    for (const ConfigNode& item : value_.node().items) {
      if (!item.inherited && !knows(item.key)) items.push_back(&item);
    }
    return items;
  }

  ConfigValue value_;
  std::vector<std::string>* notes_;
  std::vector<std::string> known_{}, missing_{};
  std::size_t found_ = 0;
};

}  // namespace articula::detail
