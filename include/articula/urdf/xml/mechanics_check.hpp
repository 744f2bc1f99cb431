// SPDX-License-Identifier: Apache-2.0
/// @file Checks of links and joints before urdfdom reads them: attributes, duplicates, the tree.
#pragma once

#include "articula/text/number_hint.hpp"
#include "articula/text/numbers.hpp"
#include "articula/text/placeholder.hpp"
#include "articula/text/similar_word.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Checks the attributes of a link or joint and of all elements in it. None may hold a placeholder
/// of xacro or of a template tool. Those which urdfdom reads as numbers must have the characters of
/// numbers. Some versions of urdfdom, such as 3.0, use a refused text as a format of printf: a mass
/// of "%s%s" would crash the program.
/// @param owner  the link or joint, for the message
/// @throws FileError with the element, the attribute and the text
inline void check_attributes(const std::string& file, const std::string& owner,
                             const XmlElement& element) {
  constexpr std::array<std::string_view, 7> elements = {"origin", "axis",    "limit", "dynamics",
                                                        "mass",   "inertia", "mimic"};
  constexpr std::array<std::string_view, 17> attributes = {
      "xyz",     "rpy",      "lower",      "upper",  "effort", "velocity",
      "damping", "friction", "multiplier", "offset", "value",  "ixx",
      "ixy",     "ixz",      "iyy",        "iyz",    "izz"};
  const std::string kind = element.Value();
  const bool has_numbers = std::ranges::find(elements, kind) != elements.end();
  for (auto each = element.FirstAttribute(); each; each = each->Next()) {
    const std::string name = each->Name();
    std::string_view text = each->Value();
    if (const auto placeholder = bracketed_placeholder_in(text); !placeholder.empty()) {
      throw FileError(file, owner + "'" + std::string(text) + "'" +
                                (placeholder.starts_with('$')
                                     ? xacro_advice
                                     : " is an unexpanded placeholder: run the template tool and "
                                       "load the result"));
    }
    if (!has_numbers || std::ranges::find(attributes, name) == attributes.end()) continue;
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
                 [&](const XmlElement& child) { check_attributes(file, owner, child); });
}

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

inline constexpr std::size_t max_links = 4096;
inline constexpr std::size_t max_chain = 512;  ///< links from the root to a leaf: urdfdom recurses

/// The name of a joint's parent or child link; empty if it has none.
[[nodiscard]] inline std::string link_name(const XmlElement& joint, const char* which) {
  return attribute(joint.FirstChildElement(which), "link");
}

/// Checks that there are not too many links and that joints name links of the file. Where links
/// have no name or a common one, urdfdom reports that.
inline void check_links(const std::string& file, const XmlElement& robot) {
  std::set<std::string> links;
  std::size_t count = 0;
  for_each_child(robot, "link", [&](const XmlElement& link) {
    links.insert(attribute(link, "name"));
    ++count;
  });
  if (count > max_links) {
    throw FileError(file, "the robot has " + std::to_string(count) + " links; at most " +
                              std::to_string(max_links) + " are supported");
  }
  if (links.size() < count || links.contains("")) return;
  for_each_child(robot, "joint", [&](const XmlElement& joint) {
    for (const char* which : {"parent", "child"}) {
      const std::string link = link_name(joint, which);
      if (link.empty() || links.contains(link)) continue;
      const std::vector<std::string_view> names(links.begin(), links.end());
      throw FileError(file, "joint '" + attribute(joint, "name") + "': its " + which + " link '" +
                                link + "' is not a <link> of the file" +
                                choice_of(link, "links", names));
    }
  });
}

/// Checks that no link has two parents or is its own ancestor, and that no chain is too long.
inline void check_tree(const std::string& file, const XmlElement& robot) {
  std::map<std::string, std::string> parents, carriers;
  for_each_child(robot, "joint", [&](const XmlElement& joint) {
    const std::string child = link_name(joint, "child"), name = attribute(joint, "name");
    if (child.empty()) throw FileError(file, "joint '" + name + "': it has no child link");
    const auto [carrier, is_new] = carriers.try_emplace(child, name);
    if (!is_new) {
      throw FileError(file, "link '" + child + "': it is the child of two joints, '" +
                                carrier->second + "' and '" + name + "'");
    }
    parents[child] = link_name(joint, "parent");
  });
  std::map<std::string, std::size_t> lengths;  // of the chain from the root, in links
  for (const auto& [start, parent] : parents) {
    std::vector<std::string> way;  // from `start` to a link whose length is known, or to a root
    std::set<std::string> seen;
    std::string link = start;
    for (; parents.contains(link) && !lengths.contains(link); link = parents.at(link)) {
      if (!seen.insert(link).second) {
        throw FileError(file, "link '" + link + "': it is part of a loop");
      }
      way.push_back(link);
    }
    std::size_t length = lengths.contains(link) ? lengths.at(link) : 1;
    for (; !way.empty(); way.pop_back()) lengths[way.back()] = ++length;
    if (length > max_chain) {
      throw FileError(file, "link '" + start + "': at most " + std::to_string(max_chain) +
                                " links in one chain are supported");
    }
  }
}

}  // namespace articula::detail
