// SPDX-License-Identifier: Apache-2.0
/// @file The <transmission>s of a URDF, which urdfdom does not read.
#pragma once

#include "articula/urdf/xml/xml.hpp"

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A joint or an actuator of a transmission.
struct UrdfTransmissionEnd {
  std::string name{};
  double mechanical_reduction = 1;  ///< turns of the actuator per turn of the joint
  std::string role{};               ///< such as "joint1", "actuator2"
  double offset = 0;  ///< of a joint: its position when the actuators are at 0 [rad or m]
};

/// The gearing between actuators and joints. articula's efforts and positions are those of the
/// joints; drivers need the gearing, see gearing_of.
struct UrdfTransmission {
  std::string name{};
  std::string type{};  ///< such as "transmission_interface/SimpleTransmission"
  std::vector<UrdfTransmissionEnd> joints{};
  std::vector<UrdfTransmissionEnd> actuators{};
};

namespace detail {

/// The text of an attribute, or of a child element of that name.
[[nodiscard]] inline std::optional<std::string> attribute_or_child(const XmlElement& element,
                                                                   const char* name) {
  if (const char* text = element.Attribute(name)) return text;
  const XmlElement* child = element.FirstChildElement(name);
  return child ? std::optional(text_of(*child)) : std::nullopt;
}

/// Reads one <transmission> in any dialect: its ends are <joint> and <actuator>, or elements such
/// as <flexJoint>, <leftActuator>. A reduction of the whole transmission is that of its actuators.
[[nodiscard]] inline UrdfTransmission read_transmission(const std::string& file,
                                                        const XmlElement& element) {
  UrdfTransmission transmission{.name = attribute(element, "name"),
                                .type = attribute(element, "type")};
  const std::string where = "transmission '" + transmission.name + "': ";
  const auto reduction = [&](const XmlElement& from, double otherwise) {
    for (const char* name : {"mechanicalReduction", "mechanical_reduction"}) {
      if (const auto text = attribute_or_child(from, name)) {
        return number_in(file, where + name, *text);
      }
    }
    return otherwise;
  };
  const auto end_of = [&](const XmlElement& end, double otherwise) -> UrdfTransmissionEnd {
    const auto offset = attribute_or_child(end, "offset");
    return {.name = attribute(end, "name"),
            .mechanical_reduction = reduction(end, otherwise),
            .role = attribute_or_child(end, "role").value_or(""),
            .offset = offset ? number_in(file, where + "offset", *offset) : 0};
  };
  const double whole = reduction(element, 1);
  for_each_child(element, nullptr, [&](const XmlElement& child) {
    const std::string_view kind = child.Value();
    if (kind == "type" || kind == "plugin") transmission.type = text_of(child);
    if (attribute(child, "name").empty()) return;
    if (kind.ends_with("ctuator")) transmission.actuators.push_back(end_of(child, whole));
    if (kind.ends_with("oint")) transmission.joints.push_back(end_of(child, 1));
  });
  return transmission;
}

/// The transmissions of a robot, those in <ros2_control> last. Joints that do not exist and
/// reductions of 0 are notices.
[[nodiscard]] inline std::vector<UrdfTransmission> read_transmissions(const std::string& file,
                                                                      const XmlElement& robot,
                                                                      NoticeList& notices) {
  std::vector<UrdfTransmission> all;
  const auto read_from = [&](const XmlElement& parent) {
    for_each_child(parent, "transmission",
                   [&](const XmlElement& e) { all.push_back(read_transmission(file, e)); });
  };
  read_from(robot);
  for_each_child(robot, "ros2_control", read_from);
  std::set<std::string> joints;
  for_each_child(robot, "joint", [&](const auto& e) { joints.insert(attribute(e, "name")); });
  for (const UrdfTransmission& transmission : all) {
    const std::string where = "transmission '" + one_line(transmission.name) + "': ";
    const auto check = [&](const std::string& kind, const UrdfTransmissionEnd& end) {
      const std::string owner = where + kind + " '" + one_line(end.name) + "': ";
      if (kind == "joint" && !joints.contains(end.name)) {
        notices.add(owner + "there is no such joint");
      }
      if (end.mechanical_reduction == 0) {
        notices.add(owner + "its mechanical reduction is 0, so it moves nothing");
      }
    };
    for (const UrdfTransmissionEnd& end : transmission.joints) check("joint", end);
    for (const UrdfTransmissionEnd& end : transmission.actuators) check("actuator", end);
  }
  return all;
}

}  // namespace detail
}  // namespace articula
