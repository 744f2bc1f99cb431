// SPDX-License-Identifier: Apache-2.0
/// @file The XML of a URDF, with the library that urdfdom itself uses: TinyXML, or TinyXML-2 from
/// urdfdom 4 on.
#pragma once

#include "articula/text/placeholder.hpp"
#include "articula/urdf/xml/error.hpp"
#include "articula/urdf/xml/tags.hpp"

#include <urdf_parser/urdf_parser.h>

#include <initializer_list>
#include <string>
#include <string_view>

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

/// Calls `use` with each child element of that name, of any name if it is null.
template <class Use>
void for_each_child(const XmlElement& parent, const char* name, Use use) {
  const auto first = name ? parent.FirstChildElement(name) : parent.FirstChildElement();
  for (const XmlElement* child = first; child;
       child = name ? child->NextSiblingElement(name) : child->NextSiblingElement()) {
    use(*child);
  }
}

/// An attribute's text, empty if there is none.
[[nodiscard]] inline std::string attribute(const XmlElement& element, const char* name) {
  const char* text = element.Attribute(name);
  return text ? text : "";
}

[[nodiscard]] inline std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// A name as a message shows it.
[[nodiscard]] inline std::string one_line(std::string text) {
  for (char& c : text) c = c == '\t' || c == '\r' || c == '\n' ? ' ' : c;
  return text;
}

/// An element's text without white space around it, empty if there is none.
[[nodiscard]] inline std::string text_of(const XmlElement& element) {
  std::string text;
  for (const auto* node = element.FirstChild(); node; node = node->NextSibling()) {
    if (node->ToText()) text += node->Value();  // what else there is are comments
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Parses XML into a document and returns its <robot>.
/// @throws UrdfError if it is not XML or no robot
inline XmlElement& parse_xml(const std::string& file, std::string text, XmlDocument& document) {
  if (text.find('<') == std::string::npos) throw UrdfError(file, "it is no XML: it has no tag");
  check_tags(file, text);
  document.Parse(text.c_str());
  if (document.Error()) {
    throw UrdfError({.file = file, .line = error_line(document)}, error_text(document));
  }
  XmlElement* robot = document.FirstChildElement("robot");
  if (!robot) {
    const XmlElement* top = document.FirstChildElement();
    throw UrdfError(file, "there is no <robot>" +
                              (top ? ", but <" + std::string(top->Value()) + ">" : std::string()));
  }
  return *robot;
}

inline constexpr const char* xacro_advice =
    " is left of xacro: have it written out (xacro r.xacro > r.urdf)";

/// @throws UrdfError if there is an element that xacro would have replaced, wherever it is: the
///         robot without it would be another one
inline void refuse_xacro(const std::string& file, const XmlElement& element) {
  const std::string name = element.Value();
  if (name.starts_with("xacro:")) throw UrdfError(file, "<" + name + ">" + xacro_advice);
  for_each_child(element, nullptr, [&](const XmlElement& child) { refuse_xacro(file, child); });
}

/// @throws UrdfError if an attribute holds what xacro or a template tool would have replaced
/// @param where  element of the robot, for the message
inline void refuse_placeholders(const std::string& file, const std::string& where,
                                const XmlElement& element) {
  for (auto each = element.FirstAttribute(); each; each = each->Next()) {
    const std::string text = each->Value();
    const std::string_view placeholder = bracketed_placeholder_in(text);
    if (placeholder.empty()) continue;
    throw UrdfError(file, where + ": '" + text + "'" +
                              (placeholder.starts_with('$')
                                   ? xacro_advice
                                   : " is a placeholder that a template tool was to fill in"));
  }
  for_each_child(element, nullptr,
                 [&](const XmlElement& child) { refuse_placeholders(file, where, child); });
}

/// Removes all child elements but those named.
inline void keep_only(XmlElement& parent, std::initializer_list<std::string_view> names) {
  for (XmlElement* child = parent.FirstChildElement(); child;) {
    XmlElement* next = child->NextSiblingElement();
    bool keep = false;
    for (std::string_view name : names) keep = keep || name == child->Value();
    if (!keep) remove(parent, *child);
    child = next;
  }
}

/// Takes the masses out of a robot.
inline void remove_inertials(XmlElement& robot) {
  for (XmlElement* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    while (XmlElement* inertial = link->FirstChildElement("inertial")) remove(*link, *inertial);
  }
}

/// Leaves of a robot what its mechanics need: what urdfdom would refuse elsewhere, such as a colour
/// that is not defined, is no concern of ours.
/// @throws UrdfError if one is written <Link> or so, which would be left out in silence
inline void keep_mechanics(const std::string& file, XmlElement& robot) {
  for_each_child(robot, nullptr, [&](const XmlElement& child) {
    const std::string lower = lower_case(child.Value());
    if (lower != child.Value() && (lower == "link" || lower == "joint")) {
      throw UrdfError(file, "<" + std::string(child.Value()) + " name=\"" +
                                attribute(child, "name") + "\">: it is written <" + lower + ">");
    }
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

}  // namespace articula::detail
