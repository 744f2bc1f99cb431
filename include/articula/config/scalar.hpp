// SPDX-License-Identifier: Apache-2.0
/// @file What YAML's scalars are: numbers, truth values, words.
#pragma once

#include "articula/config/node.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace articula::detail {

/// A text from a file as a message may show it: short, on one line, without control characters.
[[nodiscard]] inline std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result;
  for (const char c : text.substr(0, longest)) {
    const auto code = static_cast<unsigned char>(c);
    result += code < 0x20 || code == 0x7f ? '?' : c;
  }
  return text.size() > longest ? result + "..." : result;
}

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

/// A number as YAML writes it; .inf and .nan are numbers, too. Whoever reads 010 in octal and
/// whoever does not may be both right, so it is none.
[[nodiscard]] inline std::optional<double> as_number(std::string_view text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (is_one_of(text, {".nan"})) return std::numeric_limits<double>::quiet_NaN();
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (is_one_of(text, {".inf"})) return negative ? -infinity : infinity;
  if (text.empty() || text.find_first_not_of("0123456789.eE+-") != std::string_view::npos)
    return {};
  if (text.find_first_of("+-") == 0) return {};
  if (text.size() > 1 && text[0] == '0' && text.find_first_of(".eE") == std::string_view::npos) {
    return {};
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return negative ? -value : value;
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
  if (node.quoted) return "the quoted text '" + shown(node.text) + "'";
  const bool number = as_number(node.text).has_value();
  return (number ? "the number " : "the word '") + shown(node.text) + (number ? "" : "'");
}

/// How many letters must be put in, left out or changed to make one word of the other [Levenshtein
/// 1966].
[[nodiscard]] inline std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// "one of a, b, c", with the nearest of them first if one is near to what was written.
[[nodiscard]] inline std::string choice_text(const std::vector<std::string>& names,
                                             std::string_view written) {
  std::string list;
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, written.size() / 3) + 1;
  for (const std::string& name : names) {
    list += (list.empty() ? "" : ", ") + shown(name);
    if (written.size() > 64 || name.size() > 64) continue;
    const std::size_t apart = letters_apart(name, written);
    if (apart >= least || apart >= name.size()) continue;
    least = apart;
    nearest = &name;
  }
  return (nearest != nullptr ? "'" + shown(*nearest) + "'? One of " : "one of ") + list;
}

}  // namespace articula::detail
