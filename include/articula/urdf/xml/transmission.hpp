// SPDX-License-Identifier: Apache-2.0
/// @file The transmissions of a URDF, which urdfdom skips.
#pragma once

#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula {

/// A joint or an actuator of a transmission.
struct UrdfTransmissionEnd {
  std::string name{};
  double mechanical_reduction = 1;  ///< turns of the actuator per turn of the joint
  std::string role{};               ///< such as "joint1", "actuator2"
  double offset = 0;  ///< of a joint: where it is when the actuators are at 0 [rad or m]
};

/// How actuators drive joints. articula's efforts and positions are those of the joints; this is
/// for drivers, see gearing_of.
struct UrdfTransmission {
  std::string name{};
  std::string type{};  ///< such as "transmission_interface/SimpleTransmission"
  std::vector<UrdfTransmissionEnd> joints{};
  std::vector<UrdfTransmissionEnd> actuators{};
};

namespace detail {

/// A number of a file.
/// @throws UrdfError if the text is none
[[nodiscard]] inline double number_in(const std::string& file, const std::string& where,
                                      const std::string& text) {
  const auto number = number_of(text);
  if (!number) throw UrdfError(file, where + ": '" + text + "' is not a finite number");
  return *number;
}

/// Reads the transmissions of one file.
class TransmissionReader {
 public:
  explicit TransmissionReader(const std::string& file) : file_(file) {}

  void read(const XmlElement& robot) {
    for_each_child(robot, "transmission", [this](const auto& e) { add_transmission(e); });
    for_each_child(robot, "ros2_control", [this](const XmlElement& control) {
      for_each_child(control, "transmission", [this](const auto& e) { add_transmission(e); });
    });
  }

  std::vector<UrdfTransmission> transmissions{};

 private:
  /// The text that an element states as an attribute or in a child element.
  [[nodiscard]] static std::optional<std::string> statement(const XmlElement& element,
                                                            const char* name) {
    if (const char* text = element.Attribute(name)) return text;
    const XmlElement* child = element.FirstChildElement(name);
    return child ? std::optional(text_of(*child)) : std::nullopt;
  }

  [[nodiscard]] double reduction(const XmlElement& element, const std::string& where,
                                 double otherwise) const {
    for (const char* name : {"mechanicalReduction", "mechanical_reduction"}) {
      if (const auto text = statement(element, name))
        return number_in(file_, where + ": " + name, *text);
    }
    return otherwise;
  }

  /// @param otherwise  reduction of an end that states none
  [[nodiscard]] UrdfTransmissionEnd end_of(const XmlElement& element, const std::string& where,
                                           double otherwise) const {
    const auto offset = statement(element, "offset");
    return {.name = attribute(element, "name"),
            .mechanical_reduction = reduction(element, where, otherwise),
            .role = statement(element, "role").value_or(""),
            .offset = offset ? number_in(file_, where + ": offset", *offset) : 0};
  }

  /// All dialects: the ends are <joint> and <actuator>, or such as <flexJoint>, <leftActuator>. A
  /// reduction of the whole transmission is that of its actuators.
  void add_transmission(const XmlElement& element) {
    UrdfTransmission transmission{.name = attribute(element, "name"),
                                  .type = attribute(element, "type")};
    const std::string where = "transmission '" + transmission.name + "'";
    const double whole = reduction(element, where, 1);
    for_each_child(element, nullptr, [&](const XmlElement& child) {
      const std::string_view kind = child.Value();
      if (kind == "type" || kind == "plugin") transmission.type = text_of(child);
      if (attribute(child, "name").empty()) return;
      if (kind.ends_with("ctuator")) {
        transmission.actuators.push_back(end_of(child, where, whole));
      } else if (kind.ends_with("oint")) {
        transmission.joints.push_back(end_of(child, where, 1));
      }
    });
    transmissions.push_back(std::move(transmission));
  }

  const std::string& file_;
};

}  // namespace detail
}  // namespace articula
