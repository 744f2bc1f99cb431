// SPDX-License-Identifier: Apache-2.0
/// @file The attributes and elements that URDF and <ros2_control> define, and notices about others.
#pragma once

#include "articula/text/similar_word.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <string>
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

/// Reports each attribute and child of an element that a table does not list. urdfdom and
/// ros2_control ignore them without a message. Words with a colon and xmlns belong to other
/// programs.
/// @param descend  whether to check the children as well
/// @param report   called with a text for each unknown word
template <class Report>
void report_unknown_words(const XmlElement& element, const std::vector<KnownWords>& table,
                          bool descend, Report report) {
  const KnownWords* known = find_words(table, element.Value());
  if (!known) return;
  const auto is_known = [&](const std::string& word, const std::vector<std::string_view>& words,
                            const std::string& shown_word) {
    if (std::ranges::find(words, word) != words.end()) return true;
    if (word.find(':') == std::string::npos && word != "xmlns") {
      report("<" + std::string(element.Value()) + ">: the " + shown_word +
             " is unknown and is ignored" + did_you_mean(word, words));
    }
    return false;
  };
  for (auto each = element.FirstAttribute(); each; each = each->Next()) {
    const std::string name = each->Name();
    is_known(name, known->attributes, "attribute '" + name + "'");
  }
  for_each_child(element, nullptr, [&](const XmlElement& child) {
    const std::string name = child.Value();
    const bool is_defined = is_known(name, known->children, "element <" + name + ">");
    if (is_defined && descend) report_unknown_words(child, table, descend, report);
  });
}

/// A possible cause of an error, as an addition to its message: the first unknown word in a link or
/// joint that the message names.
/// @param unknown_words  notices such as "link 'arm': <link>: the attribute ..."
[[nodiscard]] inline std::string possible_cause(const std::vector<std::string>& unknown_words,
                                                std::string_view message) {
  for (const std::string& line : unknown_words) {
    const std::size_t begin = line.find('\'') + 1;
    const std::string name = line.substr(begin, line.find('\'', begin) - begin);
    if (message.find("'" + name + "'") != std::string_view::npos ||
        message.find("[" + name + "]") != std::string_view::npos) {
      return "; a possible cause: " + line;
    }
  }
  return "";
}

}  // namespace articula::detail
