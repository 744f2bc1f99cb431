// SPDX-License-Identifier: Apache-2.0
/// @file The source of a configuration: a YAML file or a string of YAML, and values of
/// placeholders.
#pragma once

#include "articula/text/text_source.hpp"

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula {

/// Values of placeholders by name: {"tf_prefix", "left_"} is the value of $(var tf_prefix).
using ConfigValues = std::map<std::string, std::string, std::less<>>;

/// A YAML file, or YAML itself, and values of the placeholders in it:
///
///     load_pid_gains(Q2d(), "pid_plus_gravity.yaml");
///     load_pid_gains(Q2d(), ConfigSource::text("joints: [...]", "my gains"));
///     load_controller(ConfigSource("ur_controllers.yaml", {{"tf_prefix", ""}}), "arm_controller");
///
/// The name of a placeholder is the text between its marks, without the words var and arg. It is
/// `kp` of $(var kp), $(arg kp), ${kp}, {{ kp }}, @kp@, <kp>, <%= kp %>, %kp% and $kp, and
/// `env HOME` of $(env HOME). Values replace placeholders before the YAML is parsed.
class ConfigSource : public detail::TextSource {
 public:
  static constexpr std::size_t capacity = std::size_t{1} << 20;  ///< largest size read [byte]

  /// @param file    its name or path
  /// @param values  of placeholders
  template <std::convertible_to<std::filesystem::path> File>
  ConfigSource(const File& file, ConfigValues values = {})  // NOLINT: a file is a source
      : TextSource(std::filesystem::path(file).string()), values_(std::move(values)) {}

  /// A source that is a string.
  /// @param yaml    the YAML
  /// @param name    its name in messages
  /// @param values  of placeholders
  [[nodiscard]] static ConfigSource text(std::string_view yaml, const std::string& name = "YAML",
                                         ConfigValues values = {}) {
    return ConfigSource(name, std::string(yaml), std::move(values));
  }

  /// The same with a further file behind it, as ros2_control takes several: the sections of all of
  /// them are one configuration. A section of one name may be in one file alone.
  [[nodiscard]] ConfigSource with(ConfigSource further) const {
    ConfigSource both = *this;
    both.further_.push_back(std::move(further));
    return both;
  }
  /// The further files.
  [[nodiscard]] const std::vector<ConfigSource>& further() const noexcept { return further_; }

  /// The values of placeholders.
  [[nodiscard]] const ConfigValues& values() const noexcept { return values_; }

  /// The YAML, with its placeholders.
  /// @throws FileError if the file cannot be read, is larger than `capacity`, or has a NUL
  ///         character
  /// Real-time: no (reads a file).
  [[nodiscard]] std::string contents() const { return read(capacity); }

 private:
  ConfigSource(std::string name, std::string yaml, ConfigValues values)
      : TextSource(std::move(name), std::move(yaml)), values_(std::move(values)) {}

  ConfigValues values_{};
  std::vector<ConfigSource> further_{};
};

}  // namespace articula
