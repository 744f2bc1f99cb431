// SPDX-License-Identifier: Apache-2.0
/// @file What YAML's scalars are: numbers, truth values, words.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/odd_character.hpp"
#include "articula/config/yaml/placeholder.hpp"

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

/// A text from a file as a message may show it: short, on one line, without control characters, and
/// with the number of characters that nobody would see.
[[nodiscard]] inline std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result;
  std::size_t taken = 0;
  while (taken < std::min(text.size(), longest)) {
    const TextCharacter character = first_character(text.substr(taken));
    taken += character.bytes.size();
    if (!odd_name(character.code).empty()) {
      result += "<" + code_text(character.code) + ">";
    } else {
      const bool control =
          character.code == 0x7f ||
          (character.code < 0x20 && static_cast<unsigned char>(character.bytes[0]) < 0x20);
      result += control ? "?" : character.bytes;
    }
  }
  return taken < text.size() ? result + "..." : result;
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

/// What a text is as a number.
struct ParsedNumber {
  bool is_number = false;  ///< it is written as one
  bool in_range = false;   ///< and a double can hold it
  double value = 0;
};

/// A number as YAML writes it; .inf and .nan are numbers, too. Whoever reads 010 in octal and
/// whoever does not may be both right, so it is none.
[[nodiscard]] inline ParsedNumber parse_number(std::string_view text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (is_one_of(text, {".nan"})) {
    return {true, true, std::numeric_limits<double>::quiet_NaN()};
  }
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (is_one_of(text, {".inf"})) return {true, true, negative ? -infinity : infinity};
  if (text.empty() || text.find_first_not_of("0123456789.eE+-") != std::string_view::npos)
    return {};
  if (text.find_first_of("+-") == 0) return {};
  if (text.size() > 1 && text[0] == '0' && text.find_first_of(".eE") == std::string_view::npos) {
    return {};
  }
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
  if (!number.is_number) {
    const std::string odd = odd_character_in(node.text);
    return "the word '" + shown(node.text) + "'" +
           (odd.empty() ? "" : ", in which there is " + odd);
  }
  return "the number " + shown(node.text) +
         (number.in_range ? "" : ", which is out of the range of numbers");
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

/// How many letters a name is from what was written, whatever the case; none where either is long.
[[nodiscard]] inline std::optional<std::size_t> distance_of(std::string_view name,
                                                            std::string_view written) {
  constexpr std::size_t longest = 64;
  if (written.size() > longest || name.size() > longest) return {};
  std::string a(name), b(written);
  for (std::string* text : {&a, &b}) {
    for (char& c : *text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return letters_apart(a, b);
}

/// The name that was probably meant; nullptr if none is near to what was written.
[[nodiscard]] inline const std::string* nearest_name(const std::vector<std::string>& names,
                                                     std::string_view written) {
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, written.size() / 3) + 1;
  for (const std::string& name : names) {
    const auto apart = distance_of(name, written);
    if (!apart || *apart >= least) continue;
    // One letter in place of another means nothing, but kp means p.
    if (*apart >= name.size() && !(*apart == 1 && written.ends_with(name))) continue;
    least = *apart;
    nearest = &name;
  }
  return nearest;
}

/// "one of a, b, c", with the nearest of them first if one is near to what was written.
/// @param most  names listed; if there are more, the nearest are
[[nodiscard]] inline std::string choice_text(
    const std::vector<std::string>& names, std::string_view written,
    std::size_t most = std::numeric_limits<std::size_t>::max()) {
  const std::string* nearest = nearest_name(names, written);
  const std::string begin =
      nearest != nullptr ? "'" + shown(*nearest) + "'? One of " : std::string("one of ");
  std::vector<std::pair<std::size_t, std::size_t>> order;  // per cent that are other letters, index
  const bool too_many = names.size() > most;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto apart = too_many ? distance_of(names[k], written) : std::nullopt;
    const std::size_t longer = std::max({names[k].size(), written.size(), std::size_t{1}});
    order.emplace_back(apart ? 100 * *apart / longer : 100, k);
  }
  if (too_many) {
    std::sort(order.begin(), order.end());
    order.resize(most);
  }
  std::string list;
  for (const auto& [share, k] : order) list += (list.empty() ? "" : ", ") + shown(names[k]);
  return begin + list + (too_many ? ", ..." : "");
}

}  // namespace articula::detail
