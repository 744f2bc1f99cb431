// SPDX-License-Identifier: Apache-2.0
/// @file A robot's description as C++.
#pragma once

#include <articula/urdf/description.hpp>

#include <string>

namespace articula {

/// How the C++ of a robot is to be named.
struct HeaderNames {
  std::string type{};        ///< name of the struct, such as "Iiwa"
  std::string name_space{};  ///< where it goes, such as "lab::robots"; empty: the global namespace
};

/// A header that defines a struct with the description as a constexpr RobotDescription. Every
/// number reads back as the same double.
/// @throws std::invalid_argument if a name is none that C++ accepts
[[nodiscard]] std::string header_text(const UrdfDescription& description, const HeaderNames& names);

}  // namespace articula
