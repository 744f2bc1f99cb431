// SPDX-License-Identifier: Apache-2.0
/// @file Why a text may not be YAML.
#pragma once

#include "articula/config/yaml/scalar.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/placeholder.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace articula::detail {

/// A line of a text, from 1.
[[nodiscard]] inline std::string_view line_of(std::string_view text, int line) {
  for (; line > 1 && !text.empty(); --line) {
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// What is likely to be why a text is not YAML, for a message; empty if that is not known.
/// @param line  where the parser stopped
[[nodiscard]] inline std::string parse_hint(std::string_view text, int line) {
  const std::string_view here = line_of(text, line);
  if (const std::string odd = odd_character_in(here); !odd.empty()) {
    return "an ordinary blank, or none, in place of " + odd;
  }
  const std::size_t first = here.find_first_not_of(" \t");
  if (first != std::string_view::npos && here.size() > first + 1 && here[first] == '-' &&
      std::string_view(" -.0123456789").find(here[first + 1]) == std::string_view::npos) {
    return "a blank behind the dash";
  }
  // That a placeholder's brackets are not closed may not be seen before the end of the text.
  std::string_view unfilled;
  int last = 0;
  for (int at = 1; at <= line && !text.empty(); ++at) {
    const std::string_view written = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(written.size() + 1, text.size()));
    const std::string_view found = placeholder_in(written.substr(0, written.find(" #")));
    if (found.empty() || written.starts_with('#')) continue;
    unfilled = found;
    last = at;
  }
  if (unfilled.empty()) return "";
  return "the placeholder '" + shown(unfilled) + "' in line " + std::to_string(last) +
         " to be filled in by a template tool before" + value_hint(unfilled);
}

}  // namespace articula::detail
