// SPDX-License-Identifier: Apache-2.0
/// @file Placeholders of template tools in a text, such as ${kp} and {{ kp }}.
#pragma once

#include "articula/text/characters.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace articula::detail {

/// The brackets of placeholders: Jinja's, ERB's, those of xacro and launch files.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 5> placeholder_brackets =
    {{{"{{", "}}"}, {"{%", "%}"}, {"<%", "%>"}, {"${", "}"}, {"$(", ")"}}};

/// The placeholder in brackets at the beginning of a text; empty if there is none. Without a
/// closing bracket it is the whole text.
[[nodiscard]] inline std::string_view bracketed_placeholder_at(std::string_view text) {
  for (const auto& [open, close] : placeholder_brackets) {
    if (!text.starts_with(open)) continue;
    const std::size_t end = text.find(close, open.size());
    return text.substr(0, end == std::string_view::npos ? end : end + close.size());
  }
  return {};
}

/// The placeholder at the beginning of a text, in brackets or between marks as in @kp@, %kp% and
/// <kp>; empty if there is none.
[[nodiscard]] inline std::string_view placeholder_at(std::string_view text) {
  const std::string_view bracketed = bracketed_placeholder_at(text);
  const bool marked = text.starts_with('@') || text.starts_with('%') || text.starts_with('<');
  if (!bracketed.empty() || !marked) return bracketed;
  const std::size_t end = text.find_first_not_of(
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-", 1);
  const char close = text[0] == '<' ? '>' : text[0];
  const bool is_name = end != std::string_view::npos && end > 1 && text[end] == close;
  return is_name ? text.substr(0, end + 1) : std::string_view();
}

/// The first placeholder in brackets in a text; empty if there is none.
[[nodiscard]] inline std::string_view bracketed_placeholder_in(std::string_view text) {
  while (!text.empty() && bracketed_placeholder_at(text).empty()) text.remove_prefix(1);
  return bracketed_placeholder_at(text);
}

/// The first placeholder in a text; empty if there is none. A whole text such as $kp is one, too.
[[nodiscard]] inline std::string_view placeholder_in(std::string_view text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::string_view found = placeholder_at(text.substr(k));
    if (!found.empty()) return found;
  }
  const bool is_variable =
      text.size() > 1 && text[0] == '$' &&
      ((text[1] >= 'a' && text[1] <= 'z') || (text[1] >= 'A' && text[1] <= 'Z') || text[1] == '_');
  return is_variable ? text : std::string_view();
}

[[nodiscard]] inline bool has_placeholder(std::string_view text) {
  return !placeholder_in(text).empty();
}

/// The name of a placeholder: the text between its marks, without blanks at its ends and without
/// the words var and arg of launch files.
[[nodiscard]] inline std::string_view placeholder_name(std::string_view placeholder) {
  std::string_view name = placeholder;
  for (const auto& [open, close] : placeholder_brackets) {
    if (!placeholder.starts_with(open)) continue;
    name.remove_prefix(open.size());
    if (name.ends_with(close)) name.remove_suffix(close.size());
    if (open == "<%" && name.starts_with('=')) name.remove_prefix(1);
  }
  if (name.size() == placeholder.size() && !name.empty()) {  // @kp@, <kp>, $kp
    name.remove_prefix(1);
    if (!name.empty() && placeholder[0] != '$') name.remove_suffix(1);
  }
  name = trimmed(name);
  for (const std::string_view word : {"var ", "arg "}) {
    if (name.starts_with(word)) name.remove_prefix(word.size());
  }
  return trimmed(name);
}

}  // namespace articula::detail
