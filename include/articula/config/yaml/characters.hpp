// SPDX-License-Identifier: Apache-2.0
/// @file The characters of a YAML file.
#pragma once

#include "articula/config/yaml/scalar.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/placeholder.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace articula::detail {

/// The text with a line feed in place of each carriage return that stands alone: to YAML that ends
/// a line, to yaml-cpp it does not.
[[nodiscard]] inline std::string with_line_feeds(std::string text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\r' && (k + 1 == text.size() || text[k + 1] != '\n')) text[k] = '\n';
  }
  return text;
}

/// A line that begins with % is an instruction to YAML, which passes over those that it does not
/// know.
inline void check_directive(const std::string& file, int line, std::string_view text) {
  if (text.starts_with("%YAML ") || text.starts_with("%TAG ")) return;
  const std::string_view here = text.substr(0, text.find_first_of("\r\n"));
  throw FileError({file, line, 1, ""},
                  has_placeholder(here) ? unfilled_text(placeholder_in(here))
                                        : "a % at the beginning of the line",
                  has_placeholder(here) ? "its value" + value_example(here) : "a key");
}

/// What YAML parsers disagree on: NUL, and tabs as indentation; and UTF-16.
inline void check_characters(const std::string& file, std::string_view text) {
  int line = 1, column = 1;
  bool indentation = true;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '%' && column == 1) check_directive(file, line, text.substr(k));
    if (c == '\t' && indentation) {
      const std::size_t next = text.find_first_not_of(" \t\r", k);
      if (next != std::string_view::npos && text[next] != '\n') {
        throw FileError({file, line, column, ""}, "a tab in the indentation", "spaces");
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
