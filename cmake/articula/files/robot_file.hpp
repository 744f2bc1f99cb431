// SPDX-License-Identifier: Apache-2.0
/// @file Robots from URDF and xacro files.
#pragma once

#include <articula/urdf/xml/source.hpp>

#include <string>

namespace terminal {

/// The URDF in a file. A file whose name ends in .xacro is expanded by the program xacro.
/// @throws Refusal if xacro is not installed, or refuses the file
[[nodiscard]] articula::UrdfSource robot_source(const std::string& file);

}  // namespace terminal
