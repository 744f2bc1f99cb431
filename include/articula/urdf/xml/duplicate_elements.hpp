// SPDX-License-Identifier: Apache-2.0
/// @file Elements that occur twice where URDF defines one.
#pragma once

#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/notice_list.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace articula::detail {

/// True if two attributes are equal: the same words, or the same numbers, in the same order.
[[nodiscard]] inline bool are_equal(std::string_view a, std::string_view b) {
  for (;;) {
    const std::string_view left = take_word(a), right = take_word(b);
    if (left.empty() && right.empty()) return true;
    const auto number = number_of(left);
    if (left != right && (!number || number != number_of(right))) return false;
  }
}

/// An attribute's text, or its default if it or its element is absent (nullptr).
[[nodiscard]] inline std::string_view text_or_default(const XmlElement* element,
                                                      const std::string& name) {
  const char* text = element ? element->Attribute(name.c_str()) : nullptr;
  if (text) return text;
  if (name == "xyz" || name == "rpy") return "0 0 0";
  if (name == "multiplier") return "1";
  const bool is_zero = name == "offset" || name == "lower" || name == "upper" ||
                       name == "damping" || name == "friction";
  return is_zero ? "0" : "";
}

/// True if two elements are equal in all that URDF defines for them.
/// @param a, b  one of them may be absent (nullptr)
[[nodiscard]] inline bool are_equal(const XmlElement* a, const XmlElement* b) {
  const KnownWords* known = find_words(mechanics_words(), (a ? a : b)->Value());
  if (!known) return true;  // not about mechanics
  const auto equal_attribute = [&](std::string_view word) {
    const std::string name(word);
    return are_equal(text_or_default(a, name), text_or_default(b, name));
  };
  const auto equal_child = [&](std::string_view word) {
    const std::string name(word);
    const XmlElement* left = a ? a->FirstChildElement(name.c_str()) : nullptr;
    const XmlElement* right = b ? b->FirstChildElement(name.c_str()) : nullptr;
    return (!left && !right) || are_equal(left, right);
  };
  return std::ranges::all_of(known->attributes, equal_attribute) &&
         std::ranges::all_of(known->children, equal_child);
}

/// Checks a link, a joint or an <inertial> for elements that occur twice. urdfdom reads the first
/// and ignores the second without a message. A second element that is equal or ignored is a notice.
/// @param owner  the link or joint, for the message
/// @throws FileError if two elements differ
inline void check_duplicates(const std::string& file, const XmlElement& element,
                             const std::string& owner, NoticeList& notices) {
  constexpr std::array<std::string_view, 12> unique = {
      "origin",      "parent",   "child", "axis",
      "limit",       "dynamics", "mimic", "safety_controller",
      "calibration", "inertial", "mass",  "inertia"};
  const bool is_fixed = attribute(element, "type") == "fixed";
  for_each_child(element, nullptr, [&](const XmlElement& child) {
    const std::string_view name = child.Value();
    if (std::ranges::find(unique, name) == unique.end()) return;
    const XmlElement* first = element.FirstChildElement(child.Value());
    if (first == &child) {
      if (name == "inertial") check_duplicates(file, child, owner, notices);
      return;
    }
    const bool is_read = is_fixed ? name == "origin" || name == "parent" || name == "child"
                                  : name != "safety_controller" && name != "calibration";
    const std::string second = "a second <" + std::string(name) + "> ";
    if (is_read && !are_equal(first, &child)) {
      throw FileError(file, owner + second + "differs from the first: remove one of them");
    }
    notices.add(owner, second + (is_read ? "repeats the first" : "is ignored"));
  });
}

}  // namespace articula::detail
