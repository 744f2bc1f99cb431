// SPDX-License-Identifier: Apache-2.0
/// @file YAML's scalars: numbers, truth values and words, and hints about them in messages.
#pragma once

#include "articula/text/characters.hpp"
#include "articula/text/placeholder.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace articula::detail {

/// True if a text is one of some words in lower, upper or title case, the cases of YAML's words.
[[nodiscard]] inline bool is_one_of(std::string_view text,
                                    std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    std::string upper(word), title(word);
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    const std::size_t first = word.find_first_not_of('.');
    title[first] = upper[first];
    return text == word || text == upper || text == title;
  });
}

/// A text as a number.
struct ParsedNumber {
  bool is_number = false;  ///< it has the form of a number
  bool in_range = false;   ///< and a double can hold it
  double value = 0;
};

/// A number as YAML writes it, .inf and .nan included. 010 is no number: some parsers read it as an
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

/// True or false. yes, no, on and off are truth values, as in YAML 1.1.
[[nodiscard]] inline std::optional<bool> as_truth(std::string_view text) {
  if (is_one_of(text, {"true", "yes", "on"})) return true;
  if (is_one_of(text, {"false", "no", "off"})) return false;
  return {};
}

/// A placeholder as a message names it.
[[nodiscard]] inline std::string placeholder_text(std::string_view placeholder) {
  return "the placeholder '" + shown(placeholder) + "' without a value";
}

/// How to give a value to the first placeholder in a text; empty if there is none.
[[nodiscard]] inline std::string value_example(std::string_view text) {
  const std::string_view placeholder = placeholder_in(text);
  if (placeholder.empty()) return "";
  const std::string name = shown(placeholder_name(placeholder));
  return ": ConfigSource(file, {{\"" + name + "\", \"...\"}}), or articula run --value " + name +
         "=...";
}

/// Likewise, for the end of a message.
/// @param value_names  names of the values that the source has; may be empty
[[nodiscard]] inline std::string value_hint(std::string_view text,
                                            std::string_view value_names = {}) {
  if (!has_placeholder(text)) return "";
  return ", or a value for it" + value_example(text) +
         (value_names.empty() ? "" : "; there are values for " + std::string(value_names));
}

/// How to correct an unknown key; empty if that is not known.
/// @param value_names  names of the values that the source has; may be empty
[[nodiscard]] inline std::string key_hint(std::string_view key, std::string_view value_names) {
  if (has_placeholder(key)) {
    return "this placeholder to be replaced by a template tool" + value_hint(key, value_names);
  }
  if (!odd_character_in(key).empty()) return "an ordinary blank, or none";
  if (key.find("\xEF\xBC\x9A") != std::string_view::npos) return "an ordinary colon and a blank";
  if (key.find(':') != std::string_view::npos) return "a blank behind the colon";
  if (key.find('=') != std::string_view::npos) return "a colon and a blank in place of '='";
  return "";
}

}  // namespace articula::detail
