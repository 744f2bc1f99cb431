// SPDX-License-Identifier: Apache-2.0
/// @file URDF put together by tests.
#pragma once

#include <string>

namespace support {

/// A link with a possible inertia.
[[nodiscard]] inline std::string solid(const std::string& name) {
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"2\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" "
         "iyz=\"0\" "
         "izz=\"1\"/></inertial></link>";
}

/// A joint with more inside if it is given.
[[nodiscard]] inline std::string joint(const std::string& name, const std::string& type,
                                       const std::string& parent, const std::string& child,
                                       const std::string& inside = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + inside + "</joint>";
}

[[nodiscard]] inline std::string robot(const std::string& inside) {
  return "<robot name=\"r\">" + inside + "</robot>";
}

/// A pendulum with its link and joint replaced if they are given.
[[nodiscard]] inline std::string pendulum(const std::string& link = solid("rod"),
                                          const std::string& pivot = joint("pivot", "continuous",
                                                                           "base", "rod")) {
  return robot("<link name=\"base\"/>" + link + pivot);
}

}  // namespace support
