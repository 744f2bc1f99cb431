// SPDX-License-Identifier: Apache-2.0
/// @file The error that readers of files throw: what is wrong, and where.
#pragma once

#include <concepts>
#include <stdexcept>
#include <string>
#include <utility>

namespace articula {

/// A position in a file.
struct FilePlace {
  std::string file{};  ///< the file's name, or the name of a text
  int line = 0;        ///< from 1; 0: the whole file
  int column = 0;      ///< from 1; 0: the whole line
  std::string key{};   ///< keys from the top, such as "arm.ros__parameters.gravity.z"; may be empty

  /// `pid.yaml:9:10: arm.elbow.p: `, for messages. Real-time: no (allocates).
  [[nodiscard]] std::string text() const {
    std::string result = file;
    if (line > 0) result += ":" + std::to_string(line);
    if (line > 0 && column > 0) result += ":" + std::to_string(column);
    return result + ": " + (key.empty() ? "" : key + ": ");
  }
};

/// A URDF or YAML file that cannot be used: unreadable, malformed, or with a value that makes no
/// sense. `what()` is one line: position, what is wrong and, where known, what was expected:
///
///     pid.yaml:9:10: arm.elbow.p: the word 'many', expected a number
///     arm.urdf: link 'elbow': the mass is negative (-0.3 kg)
class FileError : public std::runtime_error {
 public:
  /// @param place     where
  /// @param reason    what is wrong
  /// @param expected  what would be right; may be empty
  FileError(FilePlace place, const std::string& reason, std::string expected = {})
      : std::runtime_error(place.text() + reason +
                           (expected.empty() ? "" : ", expected " + expected)),
        place_(std::move(place)),
        expected_(std::move(expected)) {}
  /// An error of a whole file.
  template <std::convertible_to<std::string> File>
  FileError(const File& file, const std::string& reason)
      : FileError(FilePlace{.file = file}, reason) {}
  /// The same error with a longer message.
  FileError(const FileError& error, const std::string& addition)
      : std::runtime_error(error.what() + addition),
        place_(error.place_),
        expected_(error.expected_) {}

  [[nodiscard]] const std::string& file() const noexcept { return place_.file; }
  [[nodiscard]] int line() const noexcept { return place_.line; }
  [[nodiscard]] int column() const noexcept { return place_.column; }
  [[nodiscard]] const std::string& key() const noexcept { return place_.key; }
  [[nodiscard]] const std::string& expected() const noexcept { return expected_; }

 private:
  FilePlace place_;
  std::string expected_;
};

}  // namespace articula
