// SPDX-License-Identifier: Apache-2.0
/// @file The characters of a YAML file.
#pragma once

#include "articula/config/error.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace articula::detail {

/// The text with a line feed in place of each carriage return that stands alone: to YAML that ends a
/// line, to yaml-cpp it does not.
[[nodiscard]] inline std::string with_line_feeds(std::string text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\r' && (k + 1 == text.size() || text[k + 1] != '\n')) text[k] = '\n';
  }
  return text;
}

/// A line of a text, from 1.
[[nodiscard]] inline std::string_view line_of(std::string_view text, int line) {
  for (; line > 1 && !text.empty(); --line) {
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// What YAML parsers disagree on: NUL, and tabs as indentation; and UTF-16.
inline void check_characters(const std::string& file, std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw ConfigError({file, 1, 1, ""}, "it is UTF-16", "UTF-8");
  }
  int line = 1, column = 1;
  bool indentation = true;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '\0') throw ConfigError({file, line, column, ""}, "a NUL character", "text");
    if (c == '\t' && indentation) {
      const std::size_t next = text.find_first_not_of(" \t\r", k);
      if (next != std::string_view::npos && text[next] != '\n') {
        throw ConfigError({file, line, column, ""}, "a tab in the indentation", "spaces");
      }
    }
    if (c != ' ') indentation = false;
    ++column;
    if (c != '\n') continue;
    ++line;
    column = 1;
    indentation = true;
  }
}

}  // namespace articula::detail
