// SPDX-License-Identifier: Apache-2.0
#include "header_text.hpp"

#include <articula/model/joint_type_name.hpp>
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

/// A text with the escapes of a string literal.
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

constexpr std::size_t element_indent = 10;
constexpr std::size_t member_indent = element_indent + 1;

/// The members of an aggregate that differ from their defaults, with designators.
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

  void add(const std::string& name, const Members& value) {
    const std::size_t column = member_indent + name.size() + std::string_view(". = ").size();
    if (!value.members_.empty()) add(name, value.text(column));
  }

  /// All of them in braces, a line each.
  /// @param indent  column of the opening brace
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
  members.add("inertia", inertia);
  members.add("inertia_orientation", link.inertia_orientation, bare.inertia_orientation);
  return members.text(element_indent);
}

std::string joint_text(const Joint& joint) {
  const Joint bare;
  Members members;
  members.add("name", quoted(joint.name));
  if (joint.type != bare.type) {
    members.add("type", "articula::JointType::" + std::string(to_string(joint.type)));
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
  members.add("limits", limits);
  members.add("damping", joint.damping, bare.damping);
  members.add("friction", joint.friction, bare.friction);
  members.add("reflected_inertia", joint.reflected_inertia, bare.reflected_inertia);
  if (!joint.mimic.joint.empty()) {
    Members mimic;
    mimic.add("joint", quoted(joint.mimic.joint));
    mimic.add("multiplier", joint.mimic.multiplier, bare.mimic.multiplier);
    mimic.add("offset", joint.mimic.offset, bare.mimic.offset);
    members.add("mimic", mimic);
  }
  if (!joint.shared_rotors.joint.empty()) {
    Members rotors;
    rotors.add("joint", quoted(joint.shared_rotors.joint));
    rotors.add("inertia", joint.shared_rotors.inertia, bare.shared_rotors.inertia);
    members.add("shared_rotors", rotors);
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
    throw std::invalid_argument("'" + names.type + "' is not a valid name of a struct");
  }
  if (!std::regex_match(names.name_space, qualified)) {
    throw std::invalid_argument("'" + names.name_space + "' is not a valid name of a namespace");
  }
}

}  // namespace

std::string header_text(const UrdfDescription& description, const HeaderNames& names) {
  const UrdfContents& robot = *description;
  check(names);
  const std::string space = names.name_space;
  std::string text = "// Made by articula_add_robot from " +
                     escaped(robot.file.substr(robot.file.find_last_of('/') + 1)) +
                     ". Edit that file instead.\n";
  text +=
      "#pragma once\n\n"
      "#include <articula/model/description.hpp>\n\n"
      "#include <array>\n\n";
  if (!space.empty()) text += "namespace " + space + " {\n\n";
  text += "/// The robot '" + escaped(robot.name) + "'";
  text += robot.notices.empty() ? "." : ". Notices:";
  for (const std::string& notice : robot.notices) text += "\n/// - " + escaped(notice);
  text += "\n";
  text += "struct " + names.type + " {\n" +
          "  static constexpr articula::RobotDescription description{\n" +
          "      .name = " + quoted(robot.name) + ",\n" +
          "      .gravity = " + vector_text(robot.gravity) + ",\n" +
          "      .links = " + array_text("Link", robot.links, link_text) + ",\n" +
          "      .joints = " + array_text("Joint", robot.joints, joint_text);
  // Compilers deduce the description's type only if no member before another one is left out.
  const auto truth = [](bool is_true) { return is_true ? "true" : "false"; };
  const bool own_tolerance = robot.right_angle_tolerance != default_right_angle_tolerance;
  if (robot.allow_unphysical || own_tolerance || robot.kinematic) {
    text += std::string(",\n      .allow_unphysical = ") + truth(robot.allow_unphysical);
  }
  if (own_tolerance || robot.kinematic) {
    text += ",\n      .right_angle_tolerance = ";
    text += constant_text(robot.right_angle_tolerance);
  }
  if (robot.kinematic) text += ",\n      .kinematic = true";
  text += "};\n};\n";
  if (!space.empty()) text += "\n}  // namespace " + space + "\n";
  return text;
}

}  // namespace articula
