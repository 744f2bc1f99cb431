// SPDX-License-Identifier: Apache-2.0
/// @file The source of a URDF: a file or a string of XML.
#pragma once

#include "articula/text/text_source.hpp"

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace articula {

/// A URDF file, or URDF itself. A string whose first character after white space is '<' is XML. Any
/// other string is a file's name.
class UrdfSource : public detail::TextSource {
 public:
  static constexpr std::size_t capacity = std::size_t{1} << 26;  ///< largest size read [byte]

  UrdfSource(const std::filesystem::path& file)  // NOLINT: a path is a source
      : TextSource(file.string()) {}
  template <std::convertible_to<std::string_view> Text>
  UrdfSource(const Text& file_or_xml)  // NOLINT: a string is a source
      : TextSource(std::string(is_xml(file_or_xml) ? "URDF" : std::string_view(file_or_xml)),
                   is_xml(file_or_xml) ? std::optional<std::string>(file_or_xml) : std::nullopt) {}

  /// The XML.
  /// @throws FileError if the file cannot be read, is larger than `capacity`, or has a NUL
  ///         character
  /// Real-time: no (reads a file).
  [[nodiscard]] std::string text() const { return read(capacity); }

 private:
  [[nodiscard]] static bool is_xml(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // UTF-8's byte order mark
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '<';
  }
};

}  // namespace articula
