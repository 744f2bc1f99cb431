// SPDX-License-Identifier: Apache-2.0
/// @file A text to read: the contents of a file, or a string.
#pragma once

#include "articula/text/file_error.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace articula::detail {

/// What sources of URDF and YAML share.
class TextSource {
 public:
  /// The file's name, or the name of the text. Real-time: yes
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 protected:
  /// @param name  of the file, or of the text
  /// @param text  the text; none: the file is read
  explicit TextSource(std::string name, std::optional<std::string> text = {})
      : name_(std::move(name)), text_(std::move(text)) {}

  /// The whole text.
  /// @param capacity  largest size accepted [byte]
  /// @throws FileError if the file cannot be read, is larger than `capacity`, or has a NUL
  ///         character
  [[nodiscard]] std::string read(std::size_t capacity) const {
    std::string text = text_ ? *text_ : file_contents(capacity);
    if (text.size() > capacity) {
      throw FileError(name_, "it is larger than " + std::to_string(capacity >> 20) + " MiB");
    }
    FilePlace place{name_, 1, 1};
    for (const char c : text) {
      if (c == '\0') {
        throw FileError(place, "a NUL character", "UTF-8 text (UTF-16 is not supported)");
      }
      place.column = c == '\n' ? 1 : place.column + 1;
      place.line += c == '\n' ? 1 : 0;
    }
    return text;
  }

 private:
  [[nodiscard]] std::string file_contents(std::size_t capacity) const {
    std::error_code ignored;
    if (std::filesystem::is_directory(name_, ignored)) {
      throw FileError(FilePlace{name_}, "it is a folder", "a file");
    }
    std::ifstream file(name_, std::ios::binary);
    if (!file) throw FileError(name_, "the file cannot be read");
    std::string text;
    char block[1 << 16];
    while (text.size() <= capacity && file.read(block, sizeof block).gcount() > 0) {
      text.append(block, static_cast<std::size_t>(file.gcount()));
    }
    return text;
  }

  std::string name_;
  std::optional<std::string> text_;
};

}  // namespace articula::detail
