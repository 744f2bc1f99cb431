// SPDX-License-Identifier: Apache-2.0
/// @file Elements of a URDF that stand twice where one counts.
#pragma once

#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// True if two attributes say the same: word by word the same text or number.
[[nodiscard]] inline bool say_the_same(std::string_view a, std::string_view b) {
  constexpr std::string_view space = " \t\r\n";
  const auto take = [&](std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(space), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(space));
    text.remove_prefix(word.size());
    return word;
  };
  for (;;) {
    const std::string_view left = take(a), right = take(b);
    if (left.empty() && right.empty()) return true;
    const auto number = number_of(left);
    if (left != right && (!number || number != number_of(right))) return false;
  }
}

/// What an attribute says, also where it or its element is left out.
[[nodiscard]] inline std::string_view said_by(const XmlElement* element, const std::string& name) {
  const char* text = element ? element->Attribute(name.c_str()) : nullptr;
  if (text) return text;
  if (name == "xyz" || name == "rpy") return "0 0 0";
  if (name == "multiplier") return "1";
  const bool is_zero = name == "offset" || name == "lower" || name == "upper" ||
                       name == "damping" || name == "friction";
  return is_zero ? "0" : "";
}

/// True if two elements say the same, as far as URDF knows their words; nullptr is one that is left
/// out.
[[nodiscard]] inline bool say_the_same(const XmlElement* a, const XmlElement* b) {
  const KnownWords* known = known_words((a ? a : b)->Value());
  if (!known) return true;  // none of those about mechanics
  for (const std::string_view word : known->attributes) {
    const std::string name(word);
    if (!say_the_same(said_by(a, name), said_by(b, name))) return false;
  }
  for (const std::string_view word : known->children) {
    const std::string name(word);
    const XmlElement* left = a ? a->FirstChildElement(name.c_str()) : nullptr;
    const XmlElement* right = b ? b->FirstChildElement(name.c_str()) : nullptr;
    if ((left || right) && !say_the_same(left, right)) return false;
  }
  return true;
}

/// Looks for what stands twice in a link, a joint or an <inertial>, of which urdfdom takes the
/// first and says nothing. Where both say the same, or it tells nothing of mechanics, that is a
/// line among the notices.
class RepeatedElements {
 public:
  /// @throws UrdfError if they say different things, for nobody knows which was meant
  RepeatedElements(const std::string& file, const XmlElement& robot) : file_(file) {
    for (const char* kind : {"link", "joint"}) {
      for_each_child(robot, kind, [&](const XmlElement& element) {
        owner_ = std::string(kind) + " '" + one_line(attribute(element, "name")) + "': ";
        look_at(element);
      });
    }
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(lines_); }

 private:
  /// Nothing of a fixed joint counts but where it is.
  [[nodiscard]] static bool counts(const XmlElement& parent, std::string_view name) {
    if (name == "safety_controller" || name == "calibration") return false;
    if (attribute(parent, "type") != "fixed") return true;
    return name == "origin" || name == "parent" || name == "child";
  }

  void look_at(const XmlElement& element) {
    constexpr std::array<std::string_view, 12> once = {
        "origin",      "parent",   "child", "axis",
        "limit",       "dynamics", "mimic", "safety_controller",
        "calibration", "inertial", "mass",  "inertia"};
    std::set<std::string_view> told;
    for_each_child(element, nullptr, [&](const XmlElement& child) {
      const std::string_view name = child.Value();
      if (std::find(once.begin(), once.end(), name) == once.end()) return;
      const XmlElement* first = element.FirstChildElement(child.Value());
      if (first == &child) {
        if (name == "inertial") look_at(child);
        return;
      }
      const bool is_same = say_the_same(first, &child);
      const std::string what = owner_ + "a second <" + std::string(name) + ">, which ";
      if (!is_same && counts(element, name)) {
        throw UrdfError(file_, what + "says something else than the first");
      }
      if (!told.insert(name).second) return;
      lines_.push_back(what +
                       (counts(element, name) ? "says the same as the first" : "does not count"));
    });
  }

  const std::string& file_;
  std::vector<std::string> lines_{};
  std::string owner_{};  ///< the link or joint, for the lines
};

}  // namespace articula::detail
