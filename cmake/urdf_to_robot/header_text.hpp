// SPDX-License-Identifier: Apache-2.0
/// @file Text of a C++ header with a robot's description.
#pragma once

#include <articula/urdf/description.hpp>

#include <string>

namespace articula {

/// Names in the header.
struct HeaderNames {
  std::string type{};        ///< name of the struct, such as "Iiwa"
  std::string name_space{};  ///< its namespace, such as "lab::robots"; empty: the global one
};

/// A header that defines a struct with the description as a constexpr RobotDescription. Every
/// number reads back as the same double.
/// @throws std::invalid_argument if a name is not valid in C++
[[nodiscard]] std::string header_text(const UrdfDescription& description, const HeaderNames& names);

}  // namespace articula
