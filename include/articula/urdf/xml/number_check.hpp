// SPDX-License-Identifier: Apache-2.0
/// @file Texts in a URDF that are to be numbers and are none.
#pragma once

#include "articula/text/number_hint.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace articula::detail {

/// Makes sure that what stands for numbers is of the characters of numbers. urdfdom would refuse
/// the rest as well, but some versions (3.0 is one) take a text that they refuse for a format of
/// printf, so that a mass of "%s%s" ends the program.
/// @param where  the link or joint, for the message
/// @throws UrdfError with the element, the attribute and the text
inline void check_numbers(const std::string& file, const std::string& where,
                          const XmlElement& element) {
  // What urdfdom reads as numbers; what else stands there is nobody's concern.
  constexpr std::array<std::string_view, 7> elements = {"origin", "axis",    "limit", "dynamics",
                                                        "mass",   "inertia", "mimic"};
  constexpr std::array<std::string_view, 17> attributes = {
      "xyz",     "rpy",      "lower",      "upper",  "effort", "velocity",
      "damping", "friction", "multiplier", "offset", "value",  "ixx",
      "ixy",     "ixz",      "iyy",        "iyz",    "izz"};
  constexpr std::string_view space = " \t\r\n";
  const std::string_view kind = element.Value();
  const bool has_numbers = std::find(elements.begin(), elements.end(), kind) != elements.end();
  for (auto each = element.FirstAttribute(); each && has_numbers; each = each->Next()) {
    const std::string name = each->Name();
    if (std::find(attributes.begin(), attributes.end(), name) == attributes.end()) continue;
    std::string_view text = each->Value();
    while (text.find_first_not_of(space) != std::string_view::npos) {
      text.remove_prefix(text.find_first_not_of(space));
      const std::string word(text.substr(0, text.find_first_of(space)));
      text.remove_prefix(word.size());
      if (word.find_first_not_of("0123456789.+-eE") == std::string::npos) continue;
      throw UrdfError(file, where + ": <" + std::string(kind) + ">: " + name + ": " +
                                quoted_text(word) + " is not a finite number" +
                                (std::count(word.begin(), word.end(), ',') > 1
                                     ? "; numbers have blanks between them, and no commas"
                                     : number_hint(word)));
    }
  }
  for_each_child(element, nullptr,
                 [&](const XmlElement& child) { check_numbers(file, where, child); });
}

}  // namespace articula::detail
