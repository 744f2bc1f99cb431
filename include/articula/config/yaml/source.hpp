// SPDX-License-Identifier: Apache-2.0
/// @file Where a configuration comes from: a file or a text.
#pragma once

#include "articula/config/yaml/error.hpp"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

/// Values of placeholders by their names: {"tf_prefix", "left_"} is for $(var tf_prefix).
using ConfigValues = std::map<std::string, std::string, std::less<>>;

/// A YAML file, or YAML itself, with the values of the placeholders in it:
///
///     load_pid_gains(Q2d(), "pid_plus_gravity.yaml");
///     load_pid_gains(Q2d(), ConfigSource::text("joints: [...]", "my gains"));
///     load_controller(ConfigSource("ur_controllers.yaml", {{"tf_prefix", ""}}), "arm_controller");
///
/// The name of a placeholder is what stands between its marks, without the words var and arg:
/// `kp` of $(var kp), $(arg kp), ${kp}, {{ kp }}, @kp@, <kp>, <%= kp %>, %kp% and $kp; `env HOME`
/// of $(env HOME). A value takes the placeholder's place in the text before YAML is read.
class ConfigSource {
 public:
  static constexpr std::size_t capacity = std::size_t{1} << 20;  ///< largest size read [byte]

  /// @param file    its name or path
  /// @param values  of placeholders
  ConfigSource(const std::filesystem::path& file, ConfigValues values = {})
      : name_(file.string()), values_(std::move(values)) {}  // NOLINT: a path is one
  ConfigSource(const std::string& file, ConfigValues values = {})
      : name_(file), values_(std::move(values)) {}  // NOLINT: likewise
  ConfigSource(const char* file, ConfigValues values = {})
      : name_(file), values_(std::move(values)) {}  // NOLINT: likewise

  /// YAML that is at hand.
  /// @param yaml    the text
  /// @param name    what messages call it
  /// @param values  of placeholders
  [[nodiscard]] static ConfigSource text(std::string_view yaml, const std::string& name = "YAML",
                                         ConfigValues values = {}) {
    ConfigSource source(name, std::move(values));
    source.yaml_ = yaml;
    source.is_text_ = true;
    return source;
  }

  /// The file's name, or that of the text.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// The values of placeholders.
  [[nodiscard]] const ConfigValues& values() const noexcept { return values_; }

  /// The YAML, placeholders and all.
  /// @throws ConfigError if the file cannot be read, or is larger than `capacity`
  /// Real-time: no (reads a file).
  [[nodiscard]] std::string contents() const {
    std::string result = is_text_ ? yaml_ : read();
    if (result.size() > capacity) {
      throw ConfigError({.file = name_}, "it is larger than 1 MiB", "a configuration file");
    }
    return result;
  }

 private:
  [[nodiscard]] std::string read() const {
    std::error_code ignored;
    std::ifstream file(name_, std::ios::binary);
    if (!file || std::filesystem::is_directory(name_, ignored)) {
      throw ConfigError({.file = name_}, "the file cannot be read", "");
    }
    std::string result;
    char block[1 << 16];
    while (result.size() <= capacity && file.read(block, sizeof block).gcount() > 0) {
      result.append(block, static_cast<std::size_t>(file.gcount()));
    }
    return result;
  }

  std::string name_;
  ConfigValues values_{};
  std::string yaml_{};
  bool is_text_ = false;
};

}  // namespace articula
