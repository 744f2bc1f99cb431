// SPDX-License-Identifier: Apache-2.0
/// @file The parts of a URDF about drives, which urdfdom skips: <ros2_control> and <transmission>.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/model/urdf/numbers.hpp"
#include "articula/model/urdf/xml.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace articula {

/// A joint or an actuator of a transmission.
struct UrdfTransmissionEnd {
  std::string name{};
  double mechanical_reduction = 1;  ///< turns of the actuator per turn of the joint
  std::string role{};               ///< such as "joint1", "actuator2"
  double offset = 0;  ///< of a joint: where it is when the actuators are at 0 [rad or m]
};

/// Where a joint starts in a simulation, as far as it is told.
struct UrdfInitialValues {
  std::optional<double> position{};  ///< [rad or m]
  std::optional<double> velocity{};  ///< [rad/s or m/s]
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

/// Reads the parts about drives of one file.
class ControlReader {
 public:
  explicit ControlReader(const std::string& file) : file_(file) {}

  void read(const XmlElement& robot) {
    for_each_child(robot, "transmission", [this](const auto& e) { add_transmission(e); });
    for_each_child(robot, "ros2_control", [this](const XmlElement& control) {
      for_each_child(control, "joint", [this](const auto& e) {
        add_limits(e);
        add_mimic(e);
        add_initial_values(e);
      });
      for_each_child(control, "transmission", [this](const auto& e) { add_transmission(e); });
    });
  }

  std::map<std::string, JointLimits> limits{};                ///< of the commands, by joint
  std::map<std::string, std::string> contradictions{};        ///< why they cannot be, likewise
  std::vector<std::string> unread{};                          ///< what among them is no number
  std::map<std::string, UrdfInitialValues> initial_values{};  ///< by joint
  std::map<std::string, std::string> mimics{};                ///< whom, by joint; empty: nobody
  std::vector<UrdfTransmission> transmissions{};

 private:
  [[nodiscard]] double number(const std::string& text, const std::string& where) const {
    const auto number = number_of(text);
    if (!number) throw UrdfError(file_, where + ": '" + text + "' is not a finite number");
    return *number;
  }

  /// A number, "inf" for none, or what does not count: files of UR arms have {-2*pi} where xacro
  /// wanted ${-2*pi}.
  [[nodiscard]] double bound_of(const std::string& text, const std::string& where,
                                double otherwise) {
    constexpr double infinity = JointLimits::infinity;
    if (text == "inf" || text == "+inf" || text == ".inf") return infinity;
    if (text == "-inf" || text == "-.inf") return -infinity;
    if (text.starts_with('{') && text.ends_with('}')) {
      unread.push_back(where + ": '" + text + "' is no number and does not count");
      return otherwise;
    }
    return number(text, where);
  }

  [[nodiscard]] static bool is_disabled(const XmlElement& element) {
    const XmlElement* limits = element.FirstChildElement("limits");
    return limits && attribute(*limits, "enable") == "false";
  }

  /// The limits of the commands that a joint takes: <param name="min"> and "max" of its
  /// <command_interface>s. Of the two bounds of a velocity or effort the narrower counts, but for
  /// 0, which leaves one direction only.
  void add_limits(const XmlElement& joint) {
    const std::string name = attribute(joint, "name");
    if (name.empty()) throw UrdfError(file_, "<ros2_control>: a joint has no name");
    JointLimits& narrowed = limits[name];
    if (is_disabled(joint)) return;
    for_each_child(joint, "command_interface", [&](const XmlElement& command) {
      if (is_disabled(command)) return;
      const std::string kind = attribute(command, "name");
      if (kind != "position" && kind != "velocity" && kind != "effort") return;
      JointLimits bounds{};
      for_each_child(command, "param", [&](const XmlElement& param) {
        const std::string which = attribute(param, "name");
        if (which != "min" && which != "max") return;
        const std::string where = "<ros2_control>: joint '" + name + "': " + kind + " " + which;
        double& bound = which == "min" ? bounds.lower : bounds.upper;
        bound = bound_of(text_of(param), where, bound);
      });
      check_bounds(name, kind, bounds);
      const double below = std::abs(bounds.lower), above = std::abs(bounds.upper);
      const double size =
          below == 0 || above == 0 ? std::max(below, above) : std::min(below, above);
      if (kind == "velocity") narrowed.velocity = std::min(narrowed.velocity, size);
      if (kind == "effort") narrowed.effort = std::min(narrowed.effort, size);
      if (kind != "position") return;
      narrowed.lower = std::max(narrowed.lower, bounds.lower);
      narrowed.upper = std::min(narrowed.upper, bounds.upper);
    });
  }

  /// Notes velocities or efforts among which 0 is not.
  void check_bounds(const std::string& joint, const std::string& kind, const JointLimits& bounds) {
    if (kind == "position" || (bounds.lower <= 0 && bounds.upper >= 0)) return;
    contradictions.try_emplace(joint, kind + ": 0 is not within its limits (min " +
                                          number_text(bounds.lower) + ", max " +
                                          number_text(bounds.upper) + ")");
  }

  /// <joint mimic="false"> and, as in older versions, <param name="mimic">.
  void add_mimic(const XmlElement& joint) {
    const std::string name = attribute(joint, "name");
    if (attribute(joint, "mimic") == "false") mimics[name] = "";
    for_each_child(joint, "param", [&](const XmlElement& param) {
      if (attribute(param, "name") == "mimic") mimics[name] = text_of(param);
    });
  }

  /// <param name="initial_value"> of the joint's <state_interface>s.
  void add_initial_values(const XmlElement& joint) {
    const std::string name = attribute(joint, "name");
    for_each_child(joint, "state_interface", [&](const XmlElement& state) {
      const std::string kind = attribute(state, "name");
      for_each_child(state, "param", [&](const XmlElement& param) {
        if (attribute(param, "name") != "initial_value") return;
        if (kind != "position" && kind != "velocity") return;
        const double value = number(
            text_of(param), "<ros2_control>: joint '" + name + "': initial_value of " + kind);
        UrdfInitialValues& values = initial_values[name];
        (kind == "position" ? values.position : values.velocity) = value;
      });
    });
  }

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
      if (const auto text = statement(element, name)) return number(*text, where + ": " + name);
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
            .offset = offset ? number(*offset, where + ": offset") : 0};
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
