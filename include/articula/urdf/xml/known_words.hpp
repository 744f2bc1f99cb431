// SPDX-License-Identifier: Apache-2.0
/// @file The attributes and child elements that URDF and <ros2_control> define.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The attributes and children that an element may have.
struct KnownWords {
  std::string_view element{};
  std::vector<std::string_view> attributes{};
  std::vector<std::string_view> children{};
};

/// The elements about mechanics, from URDF's specification and urdfdom. <origin>'s quat_xyzw of
/// newer versions is absent on purpose: this library does not read it, so a notice names it.
/// Sources: https://wiki.ros.org/urdf/XML; xsd/urdf.xsd of https://github.com/ros/urdfdom
[[nodiscard]] inline const std::vector<KnownWords>& mechanics_words() {
  static const std::vector<KnownWords> table = {
      {"joint",
       {"name", "type"},
       {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller",
        "calibration",
        // of other programs
        "gazebo", "ros2_control", "transmission", "sensor"}},
      {"link",
       {"name", "type"},
       {"inertial", "visual", "collision",
        // of other programs
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
  return table;
}

/// The elements in <ros2_control>.
/// Source: https://control.ros.org, hardware_interface of ros2_control
[[nodiscard]] inline const std::vector<KnownWords>& control_words() {
  static const std::vector<std::string_view> parts = {"command_interface", "state_interface",
                                                      "param", "limits"};
  static const std::vector<KnownWords> table = {
      {"ros2_control",
       {"name", "type", "rw_rate", "is_async", "thread_priority"},
       {"hardware", "properties", "joint", "sensor", "gpio", "transmission"}},
      {"hardware", {}, {"plugin", "group", "param"}},
      {"joint", {"name", "mimic"}, parts},
      {"sensor", {"name"}, parts},
      {"gpio", {"name"}, parts},
      {"command_interface", {"name", "data_type", "size"}, {"param", "limits"}},
      {"state_interface", {"name", "data_type", "size"}, {"param", "limits"}},
      {"limits", {"enable"}, {}},
  };
  return table;
}

/// An element's entry in a table; null for elements that the table does not describe.
[[nodiscard]] inline const KnownWords* find_words(const std::vector<KnownWords>& table,
                                                  std::string_view element) {
  const auto found = std::ranges::find(table, element, &KnownWords::element);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace articula::detail
