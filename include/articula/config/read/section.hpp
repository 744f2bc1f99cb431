// SPDX-License-Identifier: Apache-2.0
/// @file The parameters of one controller in a configuration file.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/text/file_error.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The parameters of one controller, or of the controller manager.
struct ConfigSection {
  std::string name{};      ///< of the controller; empty if the file has nothing but its parameters
  std::string path{};      ///< keys from the top
  std::string group{};     ///< its namespaces, with slashes between them
  std::string type{};      ///< from the section or from the controller manager; may be empty
  bool is_listed = false;  ///< the controller manager gives its type
  bool is_declared = false;  ///< it has ros__parameters, or a plugin's type of its own
  ConfigNode parameters{};
  std::optional<FileError> fault{};  ///< why it cannot be used; thrown only if it is used
  std::vector<std::string> notes{};  ///< on values that other sections replace

  [[nodiscard]] std::string full_name() const { return group.empty() ? name : group + "/" + name; }
  /// The place of its key.
  [[nodiscard]] FilePlace place(const std::string& file) const {
    return parameters.key_place(file, path);
  }
  [[nodiscard]] int line() const noexcept { return parameters.key_mark.line; }
  /// @throws FileError if it cannot be used
  void check() const {
    if (fault) throw FileError(*fault);
  }
};

/// The sections of a file.
struct ConfigSections {
  std::string file{};
  std::vector<ConfigSection> sections{};
  std::vector<std::string> notes{};
};

inline constexpr std::string_view ros_parameters = "ros__parameters";

/// True if parameters list joints.
[[nodiscard]] inline bool lists_joints(const ConfigNode& parameters) {
  return parameters.has_any({"joints", "dof_names", "joint_names"});
}

/// True if parameters have a plugin's type, which has a slash; a waveform's type has none.
[[nodiscard]] inline bool has_plugin_type(const ConfigNode& parameters) {
  const ConfigNode* type = parameters.find("type");
  return type != nullptr && type->text.find('/') != std::string::npos;
}

}  // namespace articula::detail
