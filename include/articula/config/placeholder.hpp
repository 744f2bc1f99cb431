// SPDX-License-Identifier: Apache-2.0
/// @file Places that a template tool was to fill in.
#pragma once

#include <array>
#include <cstddef>
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

/// The first part of a text in whose place something else was to be put: by launch files and xacro
/// (${kp}, $(var kp)), Jinja ({{ kp }}, {% if %}), CMake and autoconf (@kp@), shells ($kp, %kp%),
/// ERB (<%= kp %>) or by hand (<kp>); empty if there is none.
[[nodiscard]] inline std::string_view placeholder_in(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> brackets = {
      {{"{{", "}}"}, {"{%", "%}"}, {"<%", "%>"}, {"${", "}"}, {"$(", ")"}}};
  for (std::size_t k = 0; k < text.size(); ++k) {
    const std::string_view rest = text.substr(k);
    for (const auto& [open, close] : brackets) {
      if (!rest.starts_with(open)) continue;
      const std::size_t end = rest.find(close, open.size());
      return rest.substr(0, end == std::string_view::npos ? end : end + close.size());
    }
    std::string_view name;
    if (rest[0] == '@' || rest[0] == '%') name = marked_name(rest, rest[0]);
    if (rest[0] == '<') name = marked_name(rest, '>');
    if (!name.empty()) return name;
  }
  const bool is_variable =
      text.size() > 1 && text[0] == '$' &&
      ((text[1] >= 'a' && text[1] <= 'z') || (text[1] >= 'A' && text[1] <= 'Z') || text[1] == '_');
  return is_variable ? text : std::string_view();
}

/// True if something else was to be put in place of the text, or of a part of it.
[[nodiscard]] inline bool has_placeholder(std::string_view text) {
  return !placeholder_in(text).empty();
}

}  // namespace articula::detail
