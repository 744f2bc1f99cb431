// SPDX-License-Identifier: Apache-2.0
/// @file The words that URDF knows where it tells of mechanics.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace articula::detail {

/// What may stand in an element.
struct KnownWords {
  std::string_view element{};
  std::vector<std::string_view> attributes{};
  std::vector<std::string_view> children{};
};

/// The words of the elements about mechanics, from URDF's specification and urdfdom; null for other
/// elements, into which nobody looks. <origin>'s quat_xyzw, which newer versions have, is not among
/// them: it is not read here, and whoever writes it should know.
/// Sources: https://wiki.ros.org/urdf/XML; xsd/urdf.xsd of https://github.com/ros/urdfdom
[[nodiscard]] inline const KnownWords* known_words(std::string_view element) {
  static const std::vector<KnownWords> all = {
      {"joint",
       {"name", "type"},
       {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller",
        "calibration",
        // other programs' own
        "gazebo", "ros2_control", "transmission", "sensor"}},
      {"link",
       {"name", "type"},
       {"inertial", "visual", "collision",
        // other programs' own
        "gazebo", "ros2_control", "transmission", "sensor", "material"}},
      {"parent", {"link"}, {}},
      {"child", {"link"}, {}},
      {"origin", {"xyz", "rpy"}, {}},
      {"axis", {"xyz"}, {}},
      {"limit",
       {"lower", "upper", "effort", "velocity",
        // of version 1.2
        "acceleration", "deceleration", "jerk"},
       {}},
      {"dynamics", {"damping", "friction"}, {}},
      {"mimic", {"joint", "multiplier", "offset"}, {}},
      {"safety_controller",
       {"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"},
       {}},
      {"inertial", {}, {"origin", "mass", "inertia"}},
      {"mass", {"value"}, {}},
      {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}},
  };
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const KnownWords& words) { return words.element == element; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace articula::detail
