// SPDX-License-Identifier: Apache-2.0
/// @file Takes single values out of a configuration, and says what is wrong with them.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/core/finite.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/number_hint.hpp"
#include "articula/text/placeholder.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace articula::detail {

/// A value of a configuration and its place. It refers to the tree, which must live on.
class ConfigValue {
 public:
  ConfigValue(std::string file, const ConfigNode& node, std::string path)
      : file_(std::move(file)), node_(&node), path_(std::move(path)) {}

  [[nodiscard]] const ConfigNode& node() const noexcept { return *node_; }
  [[nodiscard]] FilePlace place() const {
    return {file_, node_->mark.line, node_->mark.column, path_};
  }
  [[noreturn]] void refuse(const std::string& reason, const std::string& expected) const {
    throw FileError(place(), reason, expected);
  }
  /// @throws FileError: what stands there, and what should
  [[noreturn]] void refuse(const std::string& expected) const {
    refuse(what_is(*node_), expected + value_hint(node_->text, node_->given));
  }

  /// A finite number.
  [[nodiscard]] double number() const {
    const double value = number_or_infinity();
    if (!is_finite(value)) refuse("a finite number");
    return value;
  }
  /// A number, or infinity in either direction.
  [[nodiscard]] double number_or_infinity() const {
    const auto value = plain() ? as_number(node_->text) : std::nullopt;
    if (!value || std::isnan(*value)) refuse("a number" + hint());
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
      refuse(expected + hint());
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
        (node_->quoted || (!parse_number(node_->text).is_number && !as_truth(node_->text) &&
                           odd_character_in(node_->text).empty()));
    if (!good) refuse("a name");
    return node_->text;
  }
  /// The name of a link or joint: a word in whose place nothing else was to be put.
  [[nodiscard]] std::string name() const {
    const std::string name = word();
    if (has_placeholder(name)) refuse("a name");
    return name;
  }
  /// One of some words; the index of it.
  [[nodiscard]] std::size_t one_of(const std::vector<std::string>& words) const {
    for (std::size_t k = 0; k < words.size(); ++k) {
      if (node_->kind == ConfigNode::Kind::scalar && node_->text == words[k]) return k;
    }
    refuse(what_is(*node_), one_of_words(node_->text, words));
  }
  [[nodiscard]] std::vector<ConfigValue> list() const {
    if (!node_->is_list()) {
      const bool is_bare = plain() && node_->text.find(',') != std::string::npos;
      refuse(is_bare ? "a list in brackets, [" + shown(node_->text) + "]" : "a list");
    }
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
  [[nodiscard]] std::string hint() const {
    if (node_->quoted && parse_number(node_->text).is_number) return " without quotes";
    const bool is_infinity = is_one_of(node_->text, {"inf", "infinity", "-inf", "-infinity"});
    if (plain() && is_infinity) return "; infinity is .inf";
    return plain() ? number_hint(node_->text) : "";
  }
  [[nodiscard]] bool plain() const noexcept {
    return node_->kind == ConfigNode::Kind::scalar && !node_->quoted;
  }

  std::string file_;
  const ConfigNode* node_;
  std::string path_;
};

}  // namespace articula::detail
