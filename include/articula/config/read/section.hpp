// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of one controller as they stand in a configuration file.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/text/file_error.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The parameters of one controller (or of the controller manager) as they stand in a file.
struct ConfigSection {
  std::string name{};   ///< of the controller; empty where the file is nothing but its parameters
  std::string path{};   ///< the keys from the top
  std::string group{};  ///< the namespaces around it, with slashes
  std::string type{};   ///< that the section or the controller manager gives it; may be empty
  bool is_listed = false;    ///< the controller manager gives its type
  bool is_declared = false;  ///< it has ros__parameters, or a plugin's type of its own
  ConfigNode parameters{};
  std::optional<FileError> fault{};  ///< why it cannot be used; no matter to who does not ask
  std::vector<std::string> notes{};  ///< on what another section has changed

  [[nodiscard]] std::string full_name() const { return group.empty() ? name : group + "/" + name; }
  /// Where it begins, for messages.
  [[nodiscard]] int line() const noexcept { return parameters.key_mark.line; }
  /// @throws FileError if it cannot be used
  void check() const {
    if (fault) throw FileError(*fault);
  }
};

/// The sections of a file, and the place of the file's top.
struct ConfigSections {
  std::string file{};
  std::vector<ConfigSection> sections{};
  std::vector<std::string> notes{};
};

inline constexpr std::string_view ros_parameters = "ros__parameters";

}  // namespace articula::detail
