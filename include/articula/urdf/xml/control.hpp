// SPDX-License-Identifier: Apache-2.0
/// @file Limits and initial values that urdfdom does not read: of <ros2_control>, URDF 1.2, and the
/// soft limits of <safety_controller>, which urdfdom refuses without k_velocity.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace articula {

/// The position and velocity of a joint at the start of a simulation.
struct UrdfInitialValues {
  std::optional<double> position{};  ///< [rad or m]
  std::optional<double> velocity{};  ///< [rad/s or m/s]
};

/// Limits of a command that allow no motion or effort.
struct LimitContradiction {
  std::string kind{};    ///< velocity, effort, torque or force
  std::string bounds{};  ///< min and max, as a text
  std::string reason{};  ///< what is wrong and what to do
};

/// The contents of <ros2_control> by joint, and the limits in <limit> and <safety_controller> that
/// urdfdom does not read.
struct UrdfControl {
  std::map<std::string, JointLimits> limits{};  ///< of the commands, and soft limits
  std::multimap<std::string, LimitContradiction> contradictions{};
  std::map<std::string, UrdfInitialValues> initial_values{};
};

namespace detail {

class ControlReader {
 public:
  ControlReader(const std::string& file, NoticeList& notices) : file_(file), notices_(notices) {}

  /// @throws FileError if a number is not one or a joint has no name
  [[nodiscard]] UrdfControl read(const XmlElement& robot) {
    for_each_child(robot, "joint", [this](const auto& joint) { read_rates(joint); });
    for_each_child(robot, "ros2_control", [this](const XmlElement& control) {
      for_each_child(control, "joint", [this](const XmlElement& joint) {
        const std::string name = attribute(joint, "name");
        if (name.empty()) throw FileError(file_, "<ros2_control>: a joint has no name");
        owner_ = "<ros2_control>: joint '" + name + "': ";
        read_limits(joint, name);
        read_initial_values(joint, name);
      });
    });
    for_each_child(robot, "joint", [this](const XmlElement& joint) { read_soft_limits(joint); });
    return std::move(result_);
  }

 private:
  static constexpr double infinity = JointLimits::infinity;

  struct Bounds {
    std::optional<double> min{}, max{};
  };

  /// A number or "inf"; nothing for an expression in braces: files of UR arms have {-2*pi} where
  /// xacro needs ${-2*pi}.
  /// @param strict  whether to throw at any other text
  [[nodiscard]] std::optional<double> bound_of(const std::string& text, const std::string& where,
                                               bool strict) {
    if (text == "inf" || text == "+inf" || text == ".inf") return infinity;
    if (text == "-inf" || text == "-.inf") return -infinity;
    const bool in_braces = text.starts_with('{') && text.ends_with('}');
    if (!in_braces && (strict || number_of(text))) return number_in(file_, where, text);
    notices_.add(where + ": '" + text + "' is not a number and is ignored");
    return std::nullopt;
  }

  /// Whether an element has <limits enable="false"/>, in any case.
  [[nodiscard]] bool is_disabled(const XmlElement& element, const std::string& where) {
    if (lower_case(attribute(element.FirstChildElement("limits"), "enable")) != "false")
      return false;
    notices_.add(where +
                 "<limits enable=\"false\"/>: min and max are ignored there, and <limit> is used");
    return true;
  }

  void read_limits(const XmlElement& joint, const std::string& name) {
    JointLimits& limits = result_.limits[name];
    if (is_disabled(joint, owner_)) return;
    for_each_child(joint, "command_interface", [&](const XmlElement& command) {
      const std::string kind = attribute(command, "name"), where = owner_ + kind;
      if (is_disabled(command, where + ": ")) return;
      const bool is_effort = kind == "torque" || kind == "force";  // synonyms of effort
      const bool is_rate = kind == "acceleration" || kind == "jerk";
      const bool strict = kind == "position" || kind == "velocity" || kind == "effort";
      if (!strict && !is_effort && !is_rate) return;
      Bounds bounds;
      for_each_child(command, "param", [&](const XmlElement& param) {
        const std::string which = attribute(param, "name");
        if (which == "min") bounds.min = bound_of(text_of(param), where + " min", strict);
        if (which == "max") bounds.max = bound_of(text_of(param), where + " max", strict);
      });
      if (kind == "position") {
        if (bounds.min) limits.lower = std::max(limits.lower, *bounds.min);
        if (bounds.max) limits.upper = std::min(limits.upper, *bounds.max);
      } else if (is_rate) {
        narrow_by_size(kind == "jerk" ? limits.jerk : limits.acceleration, where, bounds);
      } else {
        narrow_signed(kind == "velocity" ? limits.velocity : limits.effort, name, kind, bounds);
      }
    });
  }

  /// Narrows a limit that holds in both directions to the smaller bound. Bounds that exclude one
  /// direction, or 0, are contradictions.
  void narrow_signed(double& limit, const std::string& joint, const std::string& kind,
                     const Bounds& bounds) {
    const double lower = bounds.min.value_or(-infinity), upper = bounds.max.value_or(infinity);
    const std::string text = "min " + number_text(lower) + ", max " + number_text(upper);
    const auto contradict = [&](const std::string& reason) {
      result_.contradictions.insert({joint, {kind, text, reason}});
    };
    if (lower > 0 || upper < 0) return contradict("its limits (" + text + ") exclude 0");
    if ((lower == 0) != (upper == 0)) {
      return contradict("its limits (" + text +
                        ") exclude one direction, but a joint has one limit for both: give a min "
                        "below 0 and a max above 0, or <limits enable=\"false\"/>");
    }
    narrow(limit, owner_ + kind, lower, upper);
  }

  /// Narrows a limit of acceleration or jerk, whose bounds count by their size: a missing bound
  /// equals the other one. A bound of 0 is ignored, because the joint could not move.
  void narrow_by_size(double& limit, const std::string& where, const Bounds& bounds) {
    if (!bounds.min && !bounds.max) return;
    const double lower = bounds.min.value_or(bounds.max.value_or(0));
    const double upper = bounds.max.value_or(lower);
    if (lower == 0 || upper == 0) {
      notices_.add(where + ": a limit of 0 is ignored, because the joint could not move");
      if (lower == upper) return;
    }
    const auto note_sign = [&](const char* which, double bound) {
      notices_.add(where + ": the size of " + which + " " + number_text(bound) + ", " +
                   number_text(std::abs(bound)) + ", is used in both directions");
    };
    if (bounds.min && *bounds.min > 0) note_sign("min", *bounds.min);
    if (bounds.max && *bounds.max < 0) note_sign("max", *bounds.max);
    narrow(limit, where, lower == 0 ? upper : lower, upper == 0 ? lower : upper);
  }

  void narrow(double& limit, const std::string& where, double lower, double upper) {
    const double below = std::abs(lower), above = std::abs(upper);
    const double size = std::min(below, above);
    if (below != above) {
      notices_.add(where + ": min " + number_text(lower) + " and max " + number_text(upper) +
                   " differ; " + number_text(size) + " is used in both directions");
    }
    limit = std::min(limit, size);
  }

  /// Reads acceleration, deceleration and jerk of <limit>, which URDF 1.2 defines.
  void read_rates(const XmlElement& joint) {
    const XmlElement* limit = joint.FirstChildElement("limit");
    for (const char* rate : {"acceleration", "deceleration", "jerk"}) {
      const char* text = limit ? limit->Attribute(rate) : nullptr;
      if (!text) continue;
      const auto value = number_of(text);
      if (value && *value > 0) {
        JointLimits& limits = result_.limits[attribute(joint, "name")];
        double& narrowed = rate[0] == 'j' ? limits.jerk : limits.acceleration;
        narrowed = std::min(narrowed, *value);
      } else {
        notices_.add(owner_text(joint) + "<limit>: " + rate + " '" + text +
                     "' is not a number > 0 and is ignored");
      }
    }
  }

  /// Reads the soft limits of <safety_controller>; k_position is their rate. Where they cannot be
  /// used, a notice gives the reason.
  void read_soft_limits(const XmlElement& joint) {
    const XmlElement* safety = joint.FirstChildElement("safety_controller");
    const std::string type = attribute(joint, "type");
    if (!safety || type == "fixed") return;
    const auto report = [&](const std::string& text) {
      notices_.add(owner_text(joint), "<safety_controller>: " + text);
    };
    bool are_numbers = true;
    const auto number = [&](const char* name) -> std::optional<double> {
      const char* text = safety->Attribute(name);
      if (!text) return std::nullopt;
      const auto value = number_of(text);
      if (!value) report(std::string(name) + " '" + text + "' is not a number and is ignored");
      are_numbers = are_numbers && value;
      return value;
    };
    const auto lower = number("soft_lower_limit"), upper = number("soft_upper_limit");
    const auto rate = number("k_position"), damping = number("k_velocity");
    if (damping && *damping != 0) report("k_velocity is ignored");
    if (!are_numbers) return;
    if (!lower && !upper) {
      if (rate && *rate != 0) report("k_position is ignored without soft limits");
      return;
    }
    const char* fault = type == "continuous"    ? "the joint is continuous"
                        : !lower || !upper      ? "one of them is missing"
                        : !(*lower < *upper)    ? "they leave the joint no room to move"
                        : rate && !(*rate >= 0) ? "k_position is negative"
                                                : nullptr;
    if (fault) {
      return report("soft limits " + (lower ? rounded_text(*lower) : "(none)") + " .. " +
                    (upper ? rounded_text(*upper) : "(none)") + " are ignored: " + fault);
    }
    JointLimits& limits = result_.limits[attribute(joint, "name")];
    limits.soft_lower = *lower;
    limits.soft_upper = *upper;
    if (rate && *rate > 0) limits.soft_rate = *rate;
  }

  /// Reads <param name="initial_value"> of the joint's <state_interface>s.
  void read_initial_values(const XmlElement& joint, const std::string& name) {
    for_each_child(joint, "state_interface", [&](const XmlElement& state) {
      const std::string kind = attribute(state, "name");
      if (kind != "position" && kind != "velocity") return;
      for_each_child(state, "param", [&](const XmlElement& param) {
        if (attribute(param, "name") != "initial_value") return;
        UrdfInitialValues& values = result_.initial_values[name];
        (kind == "position" ? values.position : values.velocity) =
            number_in(file_, owner_ + "initial_value of " + kind, text_of(param));
      });
    });
  }

  const std::string& file_;
  NoticeList& notices_;
  UrdfControl result_{};
  std::string owner_{};  ///< the joint, for messages
};

}  // namespace detail
}  // namespace articula
