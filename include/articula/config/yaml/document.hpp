// SPDX-License-Identifier: Apache-2.0
/// @file The YAML parser. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/yaml/document_builder.hpp"
#include "articula/config/yaml/filled_text.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/config/yaml/source.hpp"
#include "articula/text/characters.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/placeholder.hpp"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>

namespace articula::detail {

/// The text with a line feed for each carriage return that stands alone. To YAML it ends a line, to
/// yaml-cpp it does not.
[[nodiscard]] inline std::string with_line_feeds(std::string text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '\r' && (k + 1 == text.size() || text[k + 1] != '\n')) text[k] = '\n';
  }
  return text;
}

/// Checks one line for tabs in its indentation, on which YAML parsers disagree, and for a % at its
/// beginning. YAML takes such a line for a directive, and ignores directives that it does not know.
/// @throws FileError
inline void check_line(const std::string& file, int number, std::string_view line) {
  const std::size_t indentation = std::min(line.find_first_not_of(' '), line.size());
  const bool is_blank = line.find_first_not_of(" \t\r") == std::string_view::npos;
  if (line.substr(indentation).starts_with('\t') && !is_blank) {
    throw FileError({file, number, static_cast<int>(indentation) + 1, ""},
                    "a tab in the indentation", "spaces");
  }
  if (!line.starts_with('%') || line.starts_with("%YAML ") || line.starts_with("%TAG ")) return;
  const std::string_view placeholder = placeholder_in(line);
  const bool none = placeholder.empty();
  throw FileError({file, number, 1, ""},
                  none ? "a % at the beginning of the line" : placeholder_text(placeholder),
                  none ? "a key" : "its value" + value_example(placeholder));
}

/// What a text that is no YAML probably lacks; empty if that is not known.
/// @param last  the line where the parser stopped
[[nodiscard]] inline std::string parse_hint(std::string_view text, int last) {
  const std::string_view line = line_of(text, last);
  if (const std::string odd = odd_character_in(line); !odd.empty()) {
    return "an ordinary blank, or none, in place of " + odd;
  }
  const std::string_view item = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
  if (item.size() > 1 && item[0] == '-' &&
      std::string_view(" -.0123456789").find(item[1]) == std::string_view::npos) {
    return "a blank behind the dash";
  }
  std::string hint;  // an earlier placeholder's bracket may be what is not closed
  for_each_line(text, [&](int number, std::string_view each) {
    const std::string_view found = placeholder_in(each.substr(0, each.find(" #")));
    if (number > last || found.empty() || each.starts_with('#')) return;
    hint = "the placeholder '" + shown(found) + "' in line " + std::to_string(number) +
           " to be replaced by a template tool" + value_hint(found);
  });
  return hint;
}

/// Parses the one document of a YAML file, with values in place of placeholders. Refuses equal
/// keys, deep nesting and aliases that multiply.
/// @throws FileError with line and column
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline ConfigNode read_document(const ConfigSource& source) {
  const std::string& file = source.name();
  const FilledText filled(file, with_line_feeds(source.contents()), source.values());
  for_each_line(filled.text(),
                [&](int number, std::string_view line) { check_line(file, number, line); });
  std::istringstream stream(filled.text());
  ConfigBuilder builder(filled, source.values());
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) continue;
  } catch (const YAML::Exception& error) {
    const FilePlace place = filled.in_file(error.mark);
    throw FileError(place, "it is not YAML: " + shown(error.msg),
                    parse_hint(filled.text(), place.line));
  }
  ConfigNode root = builder.take();
  root.key_place = {.line = 1, .column = 1};
  set_paths(root, file, "");
  if (root.kind == ConfigNode::Kind::nothing) {
    throw FileError({.file = file}, "it is empty", "parameters");
  }
  if (!root.is_map()) {
    throw FileError(root.place, root.named() + " at the top", "a map of parameters");
  }
  return root;
}

}  // namespace articula::detail
