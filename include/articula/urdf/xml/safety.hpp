// SPDX-License-Identifier: Apache-2.0
/// @file The soft limits of a URDF, which are read here and not by urdfdom: it refuses them where
/// k_velocity is missing.
#pragma once

#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/grouped_lines.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace articula {

/// The soft limits of a joint: towards one at a distance x, the speed is at most rate x.
struct UrdfSoftLimits {
  double lower = 0;                                       ///< [rad or m]
  double upper = 0;                                       ///< [rad or m]
  double rate = std::numeric_limits<double>::infinity();  ///< k_position [1/s]
};

namespace detail {

/// Reads the <safety_controller>s of joints that have positions to limit. What cannot be used does
/// not count, and a notice says so.
class SafetyReader {
 public:
  explicit SafetyReader(const XmlElement& robot) {
    for_each_child(robot, "joint", [this](const XmlElement& joint) {
      const XmlElement* safety = joint.FirstChildElement("safety_controller");
      const std::string type = attribute(joint, "type");
      if (safety && type != "fixed") read(attribute(joint, "name"), type, *safety);
    });
  }

  [[nodiscard]] const std::map<std::string, UrdfSoftLimits>& limits() const { return limits_; }
  [[nodiscard]] std::vector<std::string> notices() const { return notices_.take(); }

 private:
  void read(const std::string& joint, const std::string& type, const XmlElement& safety) {
    const std::string owner = "joint '" + one_line(joint) + "': ";
    const auto add = [&](const std::string& text) {
      notices_.add(owner, "<safety_controller>: " + text);
    };
    bool readable = true;
    const auto number = [&](const char* name) -> std::optional<double> {
      const char* text = safety.Attribute(name);
      if (!text) return std::nullopt;
      const auto value = number_of(text);
      if (!value) add(std::string(name) + " '" + text + "' is no number, so it does not count");
      readable = readable && value;
      return value;
    };
    const auto lower = number("soft_lower_limit"), upper = number("soft_upper_limit");
    const auto rate = number("k_position"), damping = number("k_velocity");
    if (damping && *damping != 0) {
      add("k_velocity does not count");
    }
    if (!readable || (!lower && !upper)) {
      if (rate && *rate != 0 && readable) add("k_position does not count without soft limits");
      return;
    }
    const std::string range = "soft limits " + (lower ? rounded_text(*lower) : "(none)") + " .. " +
                              (upper ? rounded_text(*upper) : "(none)") + " do not count: ";
    if (type == "continuous") return add(range + "the joint is continuous");
    if (!lower || !upper) return add(range + "one of them is missing");
    if (!(*lower < *upper)) return add(range + "they leave the joint no room to move");
    if (rate && !(*rate >= 0)) return add(range + "k_position is negative");
    UrdfSoftLimits& limits = limits_[joint];
    limits = {.lower = *lower, .upper = *upper};
    if (rate && *rate > 0) limits.rate = *rate;
  }

  std::map<std::string, UrdfSoftLimits> limits_{};
  GroupedLines notices_{};
};

}  // namespace detail
}  // namespace articula
