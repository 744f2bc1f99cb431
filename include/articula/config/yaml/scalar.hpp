// SPDX-License-Identifier: Apache-2.0
/// @file What YAML's scalars are: numbers, truth values, words.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/meant_word.hpp"
#include "articula/text/placeholder.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace articula::detail {

/// True if the text is one of some words, in lower, upper or title case as YAML has them.
[[nodiscard]] inline bool is_one_of(std::string_view text, const std::vector<const char*>& words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) {
    std::string lower = word, upper = lower;
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    std::string title = lower;
    for (std::size_t k = 0; k < title.size(); ++k) {
      if (title[k] == '.') continue;
      title[k] = upper[k];
      break;
    }
    return text == lower || text == upper || text == title;
  });
}

/// A text as a number.
struct ParsedNumber {
  bool is_number = false;  ///< it has the form of a number
  bool in_range = false;   ///< and a double can hold it
  double value = 0;
};

/// A number as YAML writes it, .inf and .nan included. 010 is no number: some parsers take it for an
/// octal one.
[[nodiscard]] inline ParsedNumber parse_number(std::string_view text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (is_one_of(text, {".nan"})) {
    return {true, true, std::numeric_limits<double>::quiet_NaN()};
  }
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (is_one_of(text, {".inf"})) return {true, true, negative ? -infinity : infinity};
  const bool has_sign = text.starts_with('+') || text.starts_with('-');
  const bool is_octal =
      text.size() > 1 && text[0] == '0' && text.find_first_of(".eE") == std::string_view::npos;
  if (text.find_first_not_of("0123456789.eE+-") != text.npos || has_sign || is_octal) return {};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) return {};
  return {true, error == std::errc(), negative ? -value : value};
}

/// A number that a double can hold.
[[nodiscard]] inline std::optional<double> as_number(std::string_view text) {
  const ParsedNumber number = parse_number(text);
  return number.in_range ? std::optional(number.value) : std::nullopt;
}

/// What a placeholder is, for messages.
[[nodiscard]] inline std::string unfilled_text(std::string_view placeholder) {
  return "the placeholder '" + shown(placeholder) + "', which a template tool was to fill in";
}

/// How to give the value of the first placeholder in a text; empty if there is none.
[[nodiscard]] inline std::string value_example(std::string_view text) {
  const std::string_view placeholder = placeholder_in(text);
  if (placeholder.empty()) return "";
  return ": ConfigSource(file, {{\"" + shown(placeholder_name(placeholder)) + "\", \"...\"}})";
}

/// Likewise, to be said behind what was expected in its place.
/// @param given  the names of the values that were given; may be empty
[[nodiscard]] inline std::string value_hint(std::string_view text, std::string_view given = {}) {
  if (!has_placeholder(text)) return "";
  return ", or a value for it" + value_example(text) +
         (given.empty() ? "" : "; given were values for " + std::string(given));
}

/// What is likely to be wrong with a key; empty if that is not known.
/// @param given  likewise
[[nodiscard]] inline std::string key_hint(std::string_view key, std::string_view given = {}) {
  if (has_placeholder(key)) {
    return "this placeholder to be filled in by a template tool before" + value_hint(key, given);
  }
  if (!odd_character_in(key).empty()) return "an ordinary blank, or none";
  if (key.find("\xEF\xBC\x9A") != std::string_view::npos) return "an ordinary colon and a blank";
  if (key.find(':') != std::string_view::npos) return "a blank behind the colon";
  if (key.find('=') != std::string_view::npos) return "a colon and a blank in place of '='";
  return "";
}

/// True or false; yes, no, on and off are likewise, as in YAML 1.1.
[[nodiscard]] inline std::optional<bool> as_truth(std::string_view text) {
  if (is_one_of(text, {"true", "yes", "on"})) return true;
  if (is_one_of(text, {"false", "no", "off"})) return false;
  return {};
}

/// What a node is, for messages.
[[nodiscard]] inline std::string what_is(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::nothing:
      return "nothing";
    case ConfigNode::Kind::list:
      return "a list of " + std::to_string(node.items.size());
    case ConfigNode::Kind::map:
      return "a map";
    case ConfigNode::Kind::scalar:
      break;
  }
  if (node.quoted && !has_placeholder(node.text)) {
    return "the quoted text '" + shown(node.text) + "'";
  }
  if (has_placeholder(node.text)) {
    return unfilled_text(placeholder_in(node.text));
  }
  const ParsedNumber number = parse_number(node.text);
  if (!number.is_number) return "the word " + quoted_text(node.text);
  return "the number " + shown(node.text) +
         (number.in_range ? "" : ", which is out of the range of numbers");
}

}  // namespace articula::detail
