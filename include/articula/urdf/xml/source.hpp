// SPDX-License-Identifier: Apache-2.0
/// @file Where a URDF comes from: a file or a text.
#pragma once

#include "articula/urdf/xml/error.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace articula {

/// A URDF file, or URDF itself: a string whose first character after white space is '<' is XML, any
/// other is a file's name.
class UrdfSource {
 public:
  static constexpr std::size_t capacity = std::size_t{1} << 26;  ///< largest size read [byte]

  UrdfSource(const std::filesystem::path& file)  // NOLINT: a path is a source
      : name_(file.string()) {}
  UrdfSource(std::string_view file_or_xml)  // NOLINT: a string is a source
      : name_(is_xml(file_or_xml) ? "URDF" : file_or_xml),
        xml_(is_xml(file_or_xml) ? file_or_xml : "") {}
  UrdfSource(const std::string& file_or_xml)  // NOLINT: likewise
      : UrdfSource(std::string_view(file_or_xml)) {}
  UrdfSource(const char* file_or_xml)  // NOLINT: likewise
      : UrdfSource(std::string_view(file_or_xml)) {}

  /// The file's name, for messages; "URDF" for a text. Real-time: no (may copy).
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// The XML.
  /// @throws UrdfError if the file cannot be read, is larger than `capacity`, is UTF-16 or holds a
  /// NUL
  /// Real-time: no (reads a file).
  [[nodiscard]] std::string text() const {
    std::string text = xml_.empty() ? contents() : xml_;
    if (text.size() > capacity) throw UrdfError(name_, "it is larger than 64 MiB");
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
      throw UrdfError(name_, "it is UTF-16: save it as UTF-8");
    }
    if (text.starts_with(std::string_view("<\0", 2)) ||
        text.starts_with(std::string_view("\0<", 2))) {
      throw UrdfError(name_, "it is UTF-16: save it as UTF-8");
    }
    if (text.find('\0') != std::string::npos) throw UrdfError(name_, "it is no text: it holds NUL");
    return text;
  }

 private:
  [[nodiscard]] static bool is_xml(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // UTF-8's byte order mark
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '<';
  }
  [[nodiscard]] std::string contents() const {
    std::error_code ignored;
    std::ifstream file(name_, std::ios::binary);
    if (!file || std::filesystem::is_directory(name_, ignored)) {
      throw UrdfError(name_, "the file cannot be read");
    }
    std::string text;
    char block[1 << 16];
    while (text.size() <= capacity && file.read(block, sizeof block).gcount() > 0) {
      text.append(block, static_cast<std::size_t>(file.gcount()));
    }
    return text;
  }

  std::string name_;
  std::string xml_{};
};

}  // namespace articula
