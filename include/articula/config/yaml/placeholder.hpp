// SPDX-License-Identifier: Apache-2.0
/// @file Places that a template tool was to fill in.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace articula::detail {

/// A name between two marks, such as @kp@, that begins at the first mark; empty if it is none.
[[nodiscard]] inline std::string_view marked_name(std::string_view text, char last) {
  constexpr std::string_view letters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
  const std::size_t end = text.find_first_not_of(letters, 1);
  const bool is_name = end != std::string_view::npos && end > 1 && text[end] == last;
  return is_name ? text.substr(0, end + 1) : std::string_view();
}

/// What stands around the name of a placeholder.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 5> placeholder_brackets =
    {{{"{{", "}}"}, {"{%", "%}"}, {"<%", "%>"}, {"${", "}"}, {"$(", ")"}}};

/// The placeholder at which a text begins, $kp aside; empty if it begins with none.
[[nodiscard]] inline std::string_view placeholder_at(std::string_view text) {
  for (const auto& [open, close] : placeholder_brackets) {
    if (!text.starts_with(open)) continue;
    const std::size_t end = text.find(close, open.size());
    return text.substr(0, end == std::string_view::npos ? end : end + close.size());
  }
  if (text.starts_with('@') || text.starts_with('%')) return marked_name(text, text[0]);
  return text.starts_with('<') ? marked_name(text, '>') : std::string_view();
}

/// The first part of a text in whose place something else was to be put: by launch files and xacro
/// (${kp}, $(var kp)), Jinja ({{ kp }}, {% if %}), CMake and autoconf (@kp@), shells ($kp, %kp%),
/// ERB (<%= kp %>) or by hand (<kp>); empty if there is none.
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

/// The name under which the value of a placeholder is given: what stands between its marks, without
/// blanks at its ends and the words var and arg of launch files.
[[nodiscard]] inline std::string_view placeholder_name(std::string_view placeholder) {
  std::string_view name = placeholder;
  for (const auto& [open, close] : placeholder_brackets) {
    if (!name.starts_with(open)) continue;
    name.remove_prefix(open.size());
    if (name.ends_with(close)) name.remove_suffix(close.size());
    if (open == "<%" && name.starts_with('=')) name.remove_prefix(1);
    break;
  }
  if (name.size() == placeholder.size() && !name.empty()) {  // @kp@, <kp>, $kp
    name.remove_prefix(1);
    if (!name.empty() && placeholder[0] != '$') name.remove_suffix(1);
  }
  const auto trim = [&] {
    while (name.starts_with(' ')) name.remove_prefix(1);
    while (name.ends_with(' ')) name.remove_suffix(1);
  };
  trim();
  for (const std::string_view word : {"var ", "arg "}) {
    if (name.starts_with(word)) name.remove_prefix(word.size());
  }
  trim();
  return name;
}

/// True if something else was to be put in place of the text, or of a part of it.
[[nodiscard]] inline bool has_placeholder(std::string_view text) {
  return !placeholder_in(text).empty();
}

}  // namespace articula::detail
