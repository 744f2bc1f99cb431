// SPDX-License-Identifier: Apache-2.0
/// @file What is thrown where a configuration file cannot be used.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace articula {

/// Where in a configuration something stands.
struct ConfigPlace {
  std::string file{};  ///< the file's name, or what a text was called
  int line = 0;        ///< from 1; 0: the file as a whole
  int column = 0;      ///< from 1
  std::string key{};   ///< the keys from the top, such as "arm.ros__parameters.gravity.z"
};

/// A configuration that is broken, incomplete or out of range. `what()` is one line with file,
/// line, column, key, what is wrong and what was expected, such as
/// `pid.yaml:9:10: arm.elbow.p: the word 'many', expected a number`.
class ConfigError : public std::runtime_error {
 public:
  /// @param place     where it stands
  /// @param reason    what is wrong
  /// @param expected  what would be right; may be empty
  ConfigError(ConfigPlace place, const std::string& reason, std::string expected)
      : std::runtime_error(text(place, reason, expected)),
        place_(std::move(place)),
        expected_(std::move(expected)) {}

  [[nodiscard]] const std::string& file() const noexcept { return place_.file; }
  [[nodiscard]] int line() const noexcept { return place_.line; }
  [[nodiscard]] int column() const noexcept { return place_.column; }
  [[nodiscard]] const std::string& key() const noexcept { return place_.key; }
  [[nodiscard]] const std::string& expected() const noexcept { return expected_; }

 private:
  [[nodiscard]] static std::string text(const ConfigPlace& place, const std::string& reason,
                                        const std::string& expected) {
    std::string result = place.file;
    if (place.line > 0) {
      result += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
    }
    result += ": ";
    if (!place.key.empty()) result += place.key + ": ";
    result += reason;
    if (!expected.empty()) result += ", expected " + expected;
    return result;
  }

  ConfigPlace place_;
  std::string expected_;
};

}  // namespace articula
