// SPDX-License-Identifier: Apache-2.0
/// @file One value of a configuration, converted to the type that the caller expects.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/core/finite.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/number_hint.hpp"
#include "articula/text/placeholder.hpp"
#include "articula/text/similar_word.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace articula::detail {

/// A value of a configuration with its place. It refers to the tree, which must outlive it. Each
/// conversion throws a FileError if the value has another type or is out of range.
class ConfigValue {
 public:
  /// @param path  keys from the top
  ConfigValue(std::string file, const ConfigNode& node, std::string path)
      : file_(std::move(file)), node_(&node), path_(std::move(path)) {}

  [[nodiscard]] const ConfigNode& node() const noexcept { return *node_; }
  [[nodiscard]] FilePlace place() const {
    return {file_, node_->mark.line, node_->mark.column, path_};
  }
  /// The place of the key.
  [[nodiscard]] FilePlace key_place() const { return node_->key_place(file_, path_); }
  [[noreturn]] void refuse(const std::string& reason, const std::string& expected) const {
    throw FileError(place(), reason, expected);
  }
  [[noreturn]] void refuse(const std::string& expected) const {
    refuse(node_text(*node_), expected + value_hint(node_->text, node_->value_names));
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
    const auto value = is_plain() ? as_truth(node_->text) : std::nullopt;
    if (!value) refuse("true or false");
    return *value;
  }
  /// A text. Without quotation marks it must be neither a number nor a truth value.
  [[nodiscard]] std::string word() const {
    const std::string& text = node_->text;
    const bool is_word =
        !parse_number(text).is_number && !as_truth(text) && odd_character_in(text).empty();
    if (text.empty() || !(node_->quoted || is_word)) refuse("a name");
    return text;
  }
  /// A word without placeholders: the name of a link or joint.
  [[nodiscard]] std::string name() const {
    if (has_placeholder(word())) refuse("a name");
    return word();
  }
  /// The index of this word among some words.
  [[nodiscard]] std::size_t index_in(const std::vector<std::string>& words) const {
    for (std::size_t k = 0; k < words.size(); ++k) {
      if (node_->kind == ConfigNode::Kind::scalar && node_->text == words[k]) return k;
    }
    refuse(node_text(*node_), one_of_words(node_->text, words));
  }
  [[nodiscard]] std::vector<ConfigValue> list() const {
    if (!node_->is_list()) {
      const bool has_commas = is_plain() && node_->text.find(',') != std::string::npos;
      refuse(has_commas ? "a list in brackets, [" + shown(node_->text) + "]" : "a list");
    }
    std::vector<ConfigValue> values;
    for (std::size_t k = 0; k < node_->items.size(); ++k) {
      values.emplace_back(file_, node_->items[k], path_ + "[" + std::to_string(k) + "]");
    }
    return values;
  }
  /// A value of this map.
  [[nodiscard]] ConfigValue child(const ConfigNode& item) const {
    if (!item.origin.empty()) return {file_, item, item.origin};
    return {file_, item, (path_.empty() ? "" : path_ + ".") + shown(item.key)};
  }

 private:
  [[nodiscard]] bool is_plain() const noexcept {
    return node_->kind == ConfigNode::Kind::scalar && !node_->quoted;
  }
  [[nodiscard]] ParsedNumber parsed() const {
    return is_plain() ? parse_number(node_->text) : ParsedNumber{};
  }
  /// How to correct a value that should be a number.
  [[nodiscard]] std::string hint() const {
    const bool is_number = parse_number(node_->text).is_number;
    if (node_->quoted && is_number) return " without quotes";
    if (!is_plain() || is_number) return "";
    const bool is_infinity = is_one_of(node_->text, {"inf", "infinity", "-inf", "-infinity"});
    return is_infinity ? "; infinity is .inf" : number_hint(node_->text);
  }

  std::string file_;
  const ConfigNode* node_;
  std::string path_;
};

}  // namespace articula::detail
