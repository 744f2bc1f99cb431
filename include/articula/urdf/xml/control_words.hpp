// SPDX-License-Identifier: Apache-2.0
/// @file The words that <ros2_control> knows.
#pragma once

#include "articula/text/meant_word.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The words of the elements in <ros2_control>; null for those into which nobody looks.
/// Source: https://control.ros.org, hardware_interface of ros2_control
[[nodiscard]] inline const KnownWords* known_control_words(std::string_view element) {
  static const std::vector<std::string_view> parts = {"command_interface", "state_interface",
                                                      "param", "limits"};
  static const std::vector<KnownWords> all = {
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
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const KnownWords& words) { return words.element == element; });
  return found == all.end() ? nullptr : &*found;
}

/// The attributes and children of an element in <ros2_control> that are not known there, in words.
[[nodiscard]] inline std::vector<std::string> unknown_control_words(const XmlElement& element) {
  std::vector<std::string> lines;
  const KnownWords* known = known_control_words(element.Value());
  if (!known) return lines;
  const auto look_at = [&](const std::string& word, const std::vector<std::string_view>& words,
                           const char* open, const char* close) {
    if (word.find(':') != std::string::npos || word == "xmlns") return;  // others' own
    if (std::find(words.begin(), words.end(), word) != words.end()) return;
    lines.push_back("<" + std::string(element.Value()) + ">: the " + open + word + close +
                    " is not known there and does not count" + did_you_mean(word, words));
  };
  for (auto each = element.FirstAttribute(); each; each = each->Next()) {
    look_at(each->Name(), known->attributes, "attribute '", "'");
  }
  for_each_child(element, nullptr, [&](const XmlElement& child) {
    look_at(child.Value(), known->children, "element <", ">");
  });
  return lines;
}

}  // namespace articula::detail
