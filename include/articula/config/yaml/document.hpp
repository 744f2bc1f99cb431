// SPDX-License-Identifier: Apache-2.0
/// @file The YAML parser. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/yaml/check_text.hpp"
#include "articula/config/yaml/document_builder.hpp"
#include "articula/config/yaml/filled_text.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"
#include "articula/config/yaml/source.hpp"
#include "articula/text/file_error.hpp"

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <sstream>
#include <string>

namespace articula::detail {

/// Parses the one document of a YAML file, with values in place of placeholders. Refuses equal keys,
/// deep nesting and aliases that multiply.
/// @throws FileError with line and column
/// Real-time: no (reads a file, allocates, throws).
[[nodiscard]] inline ConfigNode read_document(const ConfigSource& source) {
  const std::string& file = source.name();
  const FilledText filled(file, with_line_feeds(source.contents()), source.values());
  for_each_line(filled.text(),
                [&](int number, std::string_view line) { check_line(file, number, line); });
  std::istringstream stream(filled.text());
  ConfigBuilder builder(file, filled, source.values());
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) continue;
  } catch (const YAML::Exception& error) {
    const auto [line, column] =
        filled.in_file({std::max(error.mark.line, 0) + 1, std::max(error.mark.column, 0) + 1});
    throw FileError({file, line, column, ""}, "it is not YAML: " + shown(error.msg),
                    parse_hint(filled.text(), line));
  }
  ConfigNode root = builder.take();
  if (root.kind == ConfigNode::Kind::nothing) {
    throw FileError({.file = file}, "it is empty", "parameters");
  }
  if (!root.is_map()) {
    throw FileError({file, root.mark.line, root.mark.column, ""}, node_text(root) + " at the top",
                    "a map of parameters");
  }
  return root;
}

}  // namespace articula::detail
