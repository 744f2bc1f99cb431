// SPDX-License-Identifier: Apache-2.0
/// @file The folders of the meshes that a URDF names.
#pragma once

#include <map>
#include <string>

namespace terminal {

/// The folders of the packages whose meshes a URDF names, by the names of the packages. A note is
/// printed for each package without one.
/// @param urdf  the document
/// @param file  from which it is
[[nodiscard]] std::map<std::string, std::string> mesh_folders(const std::string& urdf,
                                                              const std::string& file);

}  // namespace terminal
