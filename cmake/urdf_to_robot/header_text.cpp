// SPDX-License-Identifier: Apache-2.0
#include "header_text.hpp"

#include <articula/text/numbers.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace articula {
namespace {

/// A double as a C++ constant; without the point, -0 would be the integer 0.
std::string constant_text(double x) {
  return x == 0 && std::signbit(x) ? "-0.0" : detail::number_text(x);
}

/// A text as it may stand in a string literal.
std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (code < 32 || code == 127) {
      result +=
          {'\\', '0', static_cast<char>('0' + code / 8 % 8), static_cast<char>('0' + code % 8)};
      if (code == 127) result[result.size() - 3] = '1';
    } else {
      result += c;
    }
  }
  return result;
}

std::string quoted(std::string_view text) { return '"' + escaped(text) + '"'; }

std::string vector_text(const Vector3<double>& a) {
  return std::string("{") + constant_text(a.x) + ", " + constant_text(a.y) + ", " +
         constant_text(a.z) + "}";
}

/// The members of an aggregate that are not as by default, with designators.
class Members {
 public:
  void add(const std::string& name, const std::string& value) {
    members_.push_back("." + name + " = " + value);
  }
  void add(const std::string& name, double value, double by_default) {
    if (value != by_default || std::signbit(value) != std::signbit(by_default)) {
      add(name, constant_text(value));
    }
  }
  void add(const std::string& name, const Vector3<double>& value,
           const Vector3<double>& by_default) {
    if (vector_text(value) != vector_text(by_default)) add(name, vector_text(value));
  }

  [[nodiscard]] bool empty() const { return members_.empty(); }

  /// All of them between braces, a line each if there are several.
  /// @param indent  where the opening brace stands
  [[nodiscard]] std::string text(std::size_t indent) const {
    const std::string separator = ",\n" + std::string(indent + 1, ' ');
    std::string result = "{";
    for (const std::string& member : members_)
      result += (&member == &members_[0] ? "" : separator) + member;
    return result + "}";
  }

 private:
  std::vector<std::string> members_{};
};

constexpr std::size_t element_indent = 10;
constexpr std::size_t member_indent = element_indent + 1;

std::string link_text(const Link& link) {
  const Link bare;
  Members members;
  members.add("name", quoted(link.name));
  members.add("mass", link.mass, bare.mass);
  members.add("center_of_mass", link.center_of_mass, bare.center_of_mass);
  Members inertia;
  inertia.add("xx", link.inertia.xx, 0);
  inertia.add("xy", link.inertia.xy, 0);
  inertia.add("xz", link.inertia.xz, 0);
  inertia.add("yy", link.inertia.yy, 0);
  inertia.add("yz", link.inertia.yz, 0);
  inertia.add("zz", link.inertia.zz, 0);
  if (!inertia.empty()) {
    members.add("inertia", inertia.text(member_indent + std::string_view(".inertia = ").size()));
  }
  members.add("inertia_orientation", link.inertia_orientation, bare.inertia_orientation);
  return members.text(element_indent);
}

std::string_view type_text(JointType type) {
  switch (type) {
    case JointType::revolute:
      return "revolute";
    case JointType::continuous:
      return "continuous";
    case JointType::prismatic:
      return "prismatic";
    case JointType::fixed:
      break;
  }
  return "fixed";
}

std::string joint_text(const Joint& joint) {
  const Joint bare;
  Members members;
  members.add("name", quoted(joint.name));
  if (joint.type != bare.type) {
    members.add("type", "articula::JointType::" + std::string(type_text(joint.type)));
  }
  members.add("parent", quoted(joint.parent));
  members.add("child", quoted(joint.child));
  members.add("origin", joint.origin, bare.origin);
  members.add("orientation", joint.orientation, bare.orientation);
  members.add("axis", joint.axis, bare.axis);
  Members limits;
  limits.add("lower", joint.limits.lower, bare.limits.lower);
  limits.add("upper", joint.limits.upper, bare.limits.upper);
  limits.add("velocity", joint.limits.velocity, bare.limits.velocity);
  limits.add("effort", joint.limits.effort, bare.limits.effort);
  limits.add("acceleration", joint.limits.acceleration, bare.limits.acceleration);
  limits.add("jerk", joint.limits.jerk, bare.limits.jerk);
  limits.add("soft_lower", joint.limits.soft_lower, bare.limits.soft_lower);
  limits.add("soft_upper", joint.limits.soft_upper, bare.limits.soft_upper);
  limits.add("soft_rate", joint.limits.soft_rate, bare.limits.soft_rate);
  if (!limits.empty()) {
    members.add("limits", limits.text(member_indent + std::string_view(".limits = ").size()));
  }
  members.add("damping", joint.damping, bare.damping);
  members.add("friction", joint.friction, bare.friction);
  members.add("reflected_inertia", joint.reflected_inertia, bare.reflected_inertia);
  if (!joint.mimic.joint.empty()) {
    Members mimic;
    mimic.add("joint", quoted(joint.mimic.joint));
    mimic.add("multiplier", joint.mimic.multiplier, bare.mimic.multiplier);
    mimic.add("offset", joint.mimic.offset, bare.mimic.offset);
    members.add("mimic", mimic.text(member_indent + std::string_view(".mimic = ").size()));
  }
  if (!joint.shared_rotors.joint.empty()) {
    Members rotors;
    rotors.add("joint", quoted(joint.shared_rotors.joint));
    rotors.add("inertia", joint.shared_rotors.inertia, bare.shared_rotors.inertia);
    members.add("shared_rotors",
                rotors.text(member_indent + std::string_view(".shared_rotors = ").size()));
  }
  return members.text(element_indent);
}

template <class Element, class Text>
std::string array_text(const char* type, const std::vector<Element>& elements, Text text) {
  std::string result = "std::to_array<articula::" + std::string(type) + ">({\n";
  for (const Element& element : elements) {
    result += std::string(element_indent, ' ') + text(element) + ",\n";
  }
  return result + "      })";
}

void check(const HeaderNames& names) {
  const std::regex identifier("[A-Za-z][A-Za-z0-9_]*");
  const std::regex qualified("([A-Za-z][A-Za-z0-9_]*(::[A-Za-z][A-Za-z0-9_]*)*)?");
  if (!std::regex_match(names.type, identifier)) {
    throw std::invalid_argument("'" + names.type + "' cannot be the name of a struct");
  }
  if (!std::regex_match(names.name_space, qualified)) {
    throw std::invalid_argument("'" + names.name_space + "' cannot be the name of a namespace");
  }
}

}  // namespace

std::string header_text(const UrdfDescription& description, const HeaderNames& names) {
  check(names);
  const std::string space = names.name_space;
  std::string text = "// Made by articula_add_robot from " +
                     escaped(description.file.substr(description.file.find_last_of('/') + 1)) +
                     ". Changes go there.\n";
  text +=
      "#pragma once\n\n"
      "#include <articula/model/description.hpp>\n\n"
      "#include <array>\n\n";
  if (!space.empty()) text += "namespace " + space + " {\n\n";
  text += "/// The robot '" + escaped(description.name) + "'";
  if (!description.notices.empty()) {
    text += ". To be known:";
    for (const std::string& notice : description.notices) text += "\n/// - " + escaped(notice);
    text += "\n";
  } else {
    text += ".\n";
  }
  text += "struct " + names.type + " {\n" +
          "  static constexpr articula::RobotDescription description{\n" +
          "      .name = " + quoted(description.name) + ",\n" +
          "      .gravity = " + vector_text(description.gravity) + ",\n" +
          "      .links = " + array_text("Link", description.links, link_text) + ",\n" +
          "      .joints = " + array_text("Joint", description.joints, joint_text);
  // Compilers that deduce the description's type want no member left out before another one.
  const auto truth = [](bool is_true) { return is_true ? "true" : "false"; };
  const bool own_tolerance = description.right_angle_tolerance != default_right_angle_tolerance;
  if (description.allow_unphysical || own_tolerance || description.kinematic) {
    text += std::string(",\n      .allow_unphysical = ") + truth(description.allow_unphysical);
  }
  if (own_tolerance || description.kinematic) {
    text += ",\n      .right_angle_tolerance = ";
    text += constant_text(description.right_angle_tolerance);
  }
  if (description.kinematic) text += ",\n      .kinematic = true";
  text += "};\n};\n";
  if (!space.empty()) text += "\n}  // namespace " + space + "\n";
  return text;
}

}  // namespace articula
