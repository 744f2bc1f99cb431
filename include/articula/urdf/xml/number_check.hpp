// SPDX-License-Identifier: Apache-2.0
/// @file Check of the attributes of a URDF that must be numbers.
#pragma once

#include "articula/text/number_hint.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace articula::detail {

/// Checks that attributes which urdfdom reads as numbers have the characters of numbers. Some
/// versions of urdfdom (3.0 is one) use a text that they refuse as a format of printf, so that a
/// mass of "%s%s" would crash the program.
/// @param owner  the link or joint, for the message
/// @throws FileError with the element, the attribute and the text
inline void check_numbers(const std::string& file, const std::string& owner,
                          const XmlElement& element) {
  constexpr std::array<std::string_view, 7> elements = {"origin", "axis",    "limit", "dynamics",
                                                        "mass",   "inertia", "mimic"};
  constexpr std::array<std::string_view, 17> attributes = {
      "xyz",     "rpy",      "lower",      "upper",  "effort", "velocity",
      "damping", "friction", "multiplier", "offset", "value",  "ixx",
      "ixy",     "ixz",      "iyy",        "iyz",    "izz"};
  const std::string kind = element.Value();
  const bool has_numbers = std::ranges::find(elements, kind) != elements.end();
  for (auto each = element.FirstAttribute(); each && has_numbers; each = each->Next()) {
    const std::string name = each->Name();
    if (std::ranges::find(attributes, name) == attributes.end()) continue;
    std::string_view text = each->Value();
    for (std::string word(take_word(text)); !word.empty(); word = take_word(text)) {
      if (word.find_first_not_of("0123456789.+-eE") == std::string::npos) continue;
      throw FileError(
          file,
          owner + "<" + kind + ">: " + name + ": " + quoted_text(word) + " is not a finite number" +
              (std::ranges::count(word, ',') > 1 ? "; separate numbers by blanks, not by commas"
                                                 : number_hint(word)));
    }
  }
  for_each_child(element, nullptr,
                 [&](const XmlElement& child) { check_numbers(file, owner, child); });
}

}  // namespace articula::detail
