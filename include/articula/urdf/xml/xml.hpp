// SPDX-License-Identifier: Apache-2.0
/// @file Access to the XML of a URDF, and notices about its elements. The library is the one that
/// urdfdom uses: TinyXML, or from urdfdom 4 on TinyXML-2.
#pragma once

#include "articula/text/file_error.hpp"
#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/tags.hpp"

#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

#if defined(TINYXML2_INCLUDED)
using XmlDocument = tinyxml2::XMLDocument;
using XmlElement = tinyxml2::XMLElement;
using XmlPrinter = tinyxml2::XMLPrinter;
[[nodiscard]] inline int error_line(const XmlDocument& document) { return document.ErrorLineNum(); }
[[nodiscard]] inline std::string error_text(const XmlDocument& document) {
  return document.ErrorStr();
}
inline void remove(XmlElement& parent, XmlElement& child) { parent.DeleteChild(&child); }
#else
using XmlDocument = TiXmlDocument;
using XmlElement = TiXmlElement;
using XmlPrinter = TiXmlPrinter;
[[nodiscard]] inline int error_line(const XmlDocument& document) { return document.ErrorRow(); }
[[nodiscard]] inline std::string error_text(const XmlDocument& document) {
  return document.ErrorDesc();
}
inline void remove(XmlElement& parent, XmlElement& child) { parent.RemoveChild(&child); }
#endif

/// The finite number that a text of a file holds.
/// @param where  element and attribute, for the message
/// @throws FileError if the text is not a finite number
[[nodiscard]] inline double number_in(const std::string& file, const std::string& where,
                                      const std::string& text) {
  const auto number = number_of(text);
  if (!number) throw FileError(file, where + ": '" + text + "' is not a finite number");
  return *number;
}

/// Calls `use` with each child element of that name; of any name if it is null.
template <class Use>
void for_each_child(const XmlElement& parent, const char* name, Use use) {
  const auto first = name ? parent.FirstChildElement(name) : parent.FirstChildElement();
  for (const XmlElement* child = first; child;
       child = name ? child->NextSiblingElement(name) : child->NextSiblingElement()) {
    use(*child);
  }
}

/// An attribute's text; empty if there is none, or no element (nullptr).
[[nodiscard]] inline std::string attribute(const XmlElement* element, const char* name) {
  const char* text = element ? element->Attribute(name) : nullptr;
  return text ? text : "";
}
[[nodiscard]] inline std::string attribute(const XmlElement& element, const char* name) {
  return attribute(&element, name);
}

[[nodiscard]] inline std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// A text on one line, for messages.
[[nodiscard]] inline std::string one_line(std::string text) {
  for (char& c : text) c = c == '\t' || c == '\r' || c == '\n' ? ' ' : c;
  return text;
}

/// The beginning of messages about an element with a name, such as "joint 'elbow': ".
[[nodiscard]] inline std::string owner_text(const XmlElement& element) {
  return std::string(element.Value()) + " '" + one_line(attribute(element, "name")) + "': ";
}

/// Calls `use` with each link, then with each joint of a robot, and with its owner_text.
template <class Use>
void for_each_link_and_joint(const XmlElement& robot, Use use) {
  for (const char* kind : {"link", "joint"}) {
    for_each_child(robot, kind, [&](const XmlElement& part) { use(part, owner_text(part)); });
  }
}

/// An element's text without white space around it; empty if there is none.
[[nodiscard]] inline std::string text_of(const XmlElement& element) {
  std::string text;
  for (const auto* node = element.FirstChild(); node; node = node->NextSibling()) {
    if (node->ToText()) text += node->Value();  // the other nodes are comments
  }
  return std::string(trimmed(text));
}

/// Parses XML into a document and returns its <robot>.
/// @throws FileError if the text is not XML or has no <robot>
inline XmlElement& parse_xml(const std::string& file, std::string text, XmlDocument& document) {
  if (text.find('<') == std::string::npos) throw FileError(file, "this is not XML: it has no tag");
  TagChecker(file, text).check();
  document.Parse(text.c_str());
  if (document.Error()) {
    throw FileError({.file = file, .line = error_line(document)}, error_text(document));
  }
  XmlElement* robot = document.FirstChildElement("robot");
  if (robot) return *robot;
  const XmlElement* top = document.FirstChildElement();
  throw FileError(file, "the top element must be <robot>" +
                            (top ? ", but is <" + std::string(top->Value()) + ">" : std::string()));
}

inline constexpr const char* xacro_advice =
    " is unexpanded xacro: run `xacro r.xacro > r.urdf` and load the result";

/// @throws FileError if any element is one that xacro expands: without it the robot would differ
inline void refuse_xacro(const std::string& file, const XmlElement& element) {
  const std::string name = element.Value();
  if (name.starts_with("xacro:")) throw FileError(file, "<" + name + ">" + xacro_advice);
  for_each_child(element, nullptr, [&](const XmlElement& child) { refuse_xacro(file, child); });
}

inline void keep_only(XmlElement& parent, std::initializer_list<std::string_view> names) {
  for (XmlElement* child = parent.FirstChildElement(); child;) {
    XmlElement* next = child->NextSiblingElement();
    if (std::ranges::find(names, child->Value()) == names.end()) remove(parent, *child);
    child = next;
  }
}

inline void remove_inertials(XmlElement& robot) {
  for (XmlElement* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    while (XmlElement* inertial = link->FirstChildElement("inertial")) remove(*link, *inertial);
  }
}

/// Keeps only the elements about mechanics, so that urdfdom cannot refuse the file for others, such
/// as an undefined colour.
/// @throws FileError if a <link> or <joint> has capital letters: urdfdom would ignore it
inline void keep_mechanics(const std::string& file, XmlElement& robot) {
  for_each_child(robot, nullptr, [&](const XmlElement& child) {
    const std::string name = child.Value(), lower = lower_case(name);
    if (lower == name || (lower != "link" && lower != "joint")) return;
    throw FileError(file, "<" + name + " name=\"" + attribute(child, "name") +
                              "\">: write the element's name as <" + lower + ">");
  });
  keep_only(robot, {"link", "joint"});
  for (XmlElement* child = robot.FirstChildElement(); child; child = child->NextSiblingElement()) {
    if (child->Value() == std::string_view("link")) {
      keep_only(*child, {"inertial"});
    } else {
      keep_only(*child, {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"});
    }
  }
}

/// Collects notices. The same text about several elements becomes one line, with the first element
/// and the number of the others.
class NoticeList {
 public:
  /// @param owner  the element, such as "link 'arm': "
  /// @param text   the notice about it
  void add(const std::string& owner, const std::string& text) {
    const auto [at, is_new] = index_.try_emplace(text, notices_.size());
    if (is_new) return notices_.push_back({.first = owner, .last = owner, .text = text});
    Notice& known = notices_[at->second];
    if (known.last == owner) return;  // one element may repeat the text
    known.last = owner;
    ++known.others;
  }

  /// Adds a line of its own.
  void add(const std::string& line) { notices_.push_back({.first = "", .last = "", .text = line}); }

  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const Notice& notice : notices_) {
      lines.push_back(notice.first + notice.text);
      if (notice.others == 0) continue;
      lines.back() += (notice.text.ends_with('?') ? " Also in " : "; also in ") +
                      std::to_string(notice.others) + " other" + (notice.others == 1 ? "" : "s");
    }
    return lines;
  }

 private:
  struct Notice {
    std::string first{};  ///< the first element that has it
    std::string last{};   ///< the last element that has it
    std::string text{};
    std::size_t others = 0;  ///< number of elements besides the first
  };

  std::vector<Notice> notices_{};
  std::map<std::string, std::size_t> index_{};  ///< of the notices, by text
};

}  // namespace articula::detail
