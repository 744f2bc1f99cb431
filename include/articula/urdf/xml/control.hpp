// SPDX-License-Identifier: Apache-2.0
/// @file What <ros2_control> says about joints, which urdfdom skips: limits, mimics, initial values.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/transmission.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace articula {

/// Where a joint starts in a simulation, as far as it is told.
struct UrdfInitialValues {
  std::optional<double> position{};  ///< [rad or m]
  std::optional<double> velocity{};  ///< [rad/s or m/s]
};

/// Limits of a command that leave it nothing.
struct LimitContradiction {
  std::string kind{};    ///< velocity, effort, torque or force
  std::string bounds{};  ///< min and max, as a text
  std::string reason{};  ///< why they cannot be, and what to do
};

namespace detail {

/// Reads what <ros2_control> says about joints, and what <limit> says that urdfdom passes over.
class ControlReader {
 public:
  explicit ControlReader(const std::string& file) : file_(file) {}

  void read(const XmlElement& robot) {
    for_each_child(robot, "joint", [this](const auto& e) { add_rates(e); });
    for_each_child(robot, "ros2_control", [this](const XmlElement& control) {
      for_each_child(control, "joint", [this](const auto& e) {
        add_limits(e);
        add_mimic(e);
        add_initial_values(e);
      });
    });
  }

  std::map<std::string, JointLimits> limits{};                      ///< of the commands, by joint
  std::multimap<std::string, LimitContradiction> contradictions{};  ///< between them, likewise
  std::vector<std::string> notices{};                               ///< what of them does not count
  std::map<std::string, UrdfInitialValues> initial_values{};        ///< by joint
  std::map<std::string, std::string> mimics{};  ///< whom, by joint; empty: nobody

 private:
  /// The bounds of a command.
  struct Bounds {
    std::optional<double> min{}, max{};
  };

  /// A number, "inf" for none, or what does not count: files of UR arms have {-2*pi} where xacro
  /// wanted ${-2*pi}.
  /// @param strict  throws at any other text, as a limit of position, velocity or effort must be one
  [[nodiscard]] std::optional<double> bound_of(const std::string& text, const std::string& where,
                                               bool strict) {
    constexpr double infinity = JointLimits::infinity;
    if (text == "inf" || text == "+inf" || text == ".inf") return infinity;
    if (text == "-inf" || text == "-.inf") return -infinity;
    const bool in_braces = text.starts_with('{') && text.ends_with('}');
    if (!in_braces && (strict || number_of(text))) return number_in(file_, where, text);
    notices.push_back(where + ": '" + text + "' is no number and does not count");
    return std::nullopt;
  }

  /// <param name="min"> and "max" of a command.
  [[nodiscard]] Bounds bounds_of(const XmlElement& command, const std::string& where,
                                 bool strict = true) {
    Bounds bounds;
    for_each_child(command, "param", [&](const XmlElement& param) {
      const std::string which = attribute(param, "name");
      if (which == "min") bounds.min = bound_of(text_of(param), where + " min", strict);
      if (which == "max") bounds.max = bound_of(text_of(param), where + " max", strict);
    });
    return bounds;
  }

  /// Whether an element has <limits enable="false"/>, capital letters or not. A notice says so.
  [[nodiscard]] bool is_disabled(const XmlElement& element, const std::string& where) {
    const XmlElement* switch_off = element.FirstChildElement("limits");
    if (!switch_off || lower_case(attribute(*switch_off, "enable")) != "false") return false;
    notices.push_back(where +
                      ": <limits enable=\"false\"/>: no min and max count there; <limit> does");
    return true;
  }

  /// The limits of the commands that a joint takes.
  void add_limits(const XmlElement& joint) {
    const std::string name = attribute(joint, "name");
    if (name.empty()) throw UrdfError(file_, "<ros2_control>: a joint has no name");
    const std::string owner = "<ros2_control>: joint '" + name + "': ";
    JointLimits& narrowed = limits[name];
    if (is_disabled(joint, "<ros2_control>: joint '" + name + "'")) return;
    for_each_child(joint, "command_interface", [&](const XmlElement& command) {
      const std::string kind = attribute(command, "name");
      const std::string where = owner + kind;
      if (is_disabled(command, where)) return;
      if (kind == "position") {
        const Bounds bounds = bounds_of(command, where);
        if (bounds.min) narrowed.lower = std::max(narrowed.lower, *bounds.min);
        if (bounds.max) narrowed.upper = std::min(narrowed.upper, *bounds.max);
      } else if (kind == "velocity") {
        narrow_signed(narrowed.velocity, name, kind, bounds_of(command, where));
      } else if (kind == "effort") {
        narrow_signed(narrowed.effort, name, kind, bounds_of(command, where));
      } else if (kind == "torque" || kind == "force") {  // other words for it
        narrow_signed(narrowed.effort, name, kind, bounds_of(command, where, false));
      } else if (kind == "acceleration") {
        narrow_by_size(narrowed.acceleration, where, bounds_of(command, where, false));
      } else if (kind == "jerk") {
        narrow_by_size(narrowed.jerk, where, bounds_of(command, where, false));
      }
    });
  }

  /// Narrows a limit that holds in both directions. The narrower bound counts; a notice says so
  /// where they differ. Bounds that leave one direction alone, or none, contradict it.
  void narrow_signed(double& limit, const std::string& joint, const std::string& kind,
                     const Bounds& bounds) {
    constexpr double infinity = JointLimits::infinity;
    const double lower = bounds.min.value_or(-infinity), upper = bounds.max.value_or(infinity);
    const std::string text = "min " + number_text(lower) + ", max " + number_text(upper);
    if (lower > 0 || upper < 0) {
      contradictions.insert({joint, {kind, text, "0 is not within its limits (" + text + ")"}});
      return;
    }
    if ((lower == 0) != (upper == 0)) {
      contradictions.insert(
          {joint,
           {kind, text,
            "its limits (" + text +
                ") leave one direction alone, and a joint has one limit for both: give min and "
                "max of both signs, or <limits enable=\"false\"/>"}});
      return;
    }
    narrow(limit, "<ros2_control>: joint '" + joint + "': " + kind, lower, upper);
  }

  /// Likewise for accelerations and jerks, whose bounds are sizes: where one is left out, it is
  /// the other one. 0 does not count, for no joint could move; a notice says so.
  void narrow_by_size(double& limit, const std::string& where, const Bounds& bounds) {
    if (!bounds.min && !bounds.max) return;
    const double lower = bounds.min.value_or(bounds.max.value_or(0));
    const double upper = bounds.max.value_or(lower);
    if (lower == 0 || upper == 0) {
      notices.push_back(where + ": a limit of 0 does not count, for the joint could not move");
      if (lower == upper) return;
    }
    const auto note_sign = [&](const char* which, double bound) {
      notices.push_back(where + ": " + which + " " + number_text(bound) + " counts as its size, " +
                        number_text(std::abs(bound)) + ", in both directions");
    };
    if (bounds.min && *bounds.min > 0) note_sign("min", *bounds.min);
    if (bounds.max && *bounds.max < 0) note_sign("max", *bounds.max);
    narrow(limit, where, lower == 0 ? upper : lower, upper == 0 ? lower : upper);
  }

  void narrow(double& limit, const std::string& where, double lower, double upper) {
    const double below = std::abs(lower), above = std::abs(upper);
    const double size = std::min(below, above);
    if (below != above) {
      notices.push_back(where + ": min " + number_text(lower) + " and max " + number_text(upper) +
                        " differ; " + number_text(size) + " counts in both directions");
    }
    limit = std::min(limit, size);
  }

  /// The acceleration, deceleration and jerk of <limit>, which URDF 1.2 has.
  void add_rates(const XmlElement& joint) {
    const XmlElement* limit = joint.FirstChildElement("limit");
    const std::string name = attribute(joint, "name");
    for (const char* rate : {"acceleration", "deceleration", "jerk"}) {
      const char* text = limit ? limit->Attribute(rate) : nullptr;
      if (!text) continue;
      const auto value = number_of(text);
      if (value && *value > 0) {
        double& narrowed = rate[0] == 'j' ? limits[name].jerk : limits[name].acceleration;
        narrowed = std::min(narrowed, *value);
      } else {
        notices.push_back("joint '" + one_line(name) + "': <limit>: " + rate + " '" + text +
                          "' is no number > 0 and does not count");
      }
    }
  }

  /// <joint mimic="false"> and, as in older versions, <param name="mimic">.
  void add_mimic(const XmlElement& joint) {
    const std::string name = attribute(joint, "name");
    if (lower_case(attribute(joint, "mimic")) == "false") mimics[name] = "";
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
        const double value =
            number_in(file_, "<ros2_control>: joint '" + name + "': initial_value of " + kind,
                      text_of(param));
        UrdfInitialValues& values = initial_values[name];
        (kind == "position" ? values.position : values.velocity) = value;
      });
    });
  }

  const std::string& file_;
};

}  // namespace detail
}  // namespace articula
