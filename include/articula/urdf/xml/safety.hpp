// SPDX-License-Identifier: Apache-2.0
/// @file The soft limits in <safety_controller>, which urdfdom refuses if k_velocity is missing.
#pragma once

#include "articula/model/joint.hpp"
#include "articula/text/numbers.hpp"
#include "articula/urdf/xml/notice_list.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <map>
#include <optional>
#include <string>

namespace articula::detail {

/// The soft limits of one joint (k_position is their rate), or nothing where they cannot be used; a notice gives the reason.
/// @param type    of the joint
/// @param report  called with the text of each notice
template <class Report>
[[nodiscard]] std::optional<JointLimits> soft_limits_of(const XmlElement& safety,
                                                        const std::string& type, Report report) {
  bool are_numbers = true;
  const auto number = [&](const char* name) -> std::optional<double> {
    const char* text = safety.Attribute(name);
    if (!text) return std::nullopt;
    const auto value = number_of(text);
    if (!value) report(std::string(name) + " '" + text + "' is not a number and is ignored");
    are_numbers = are_numbers && value;
    return value;
  };
  const auto lower = number("soft_lower_limit"), upper = number("soft_upper_limit");
  const auto rate = number("k_position"), damping = number("k_velocity");
  if (damping && *damping != 0) report("k_velocity is ignored");
  if (!are_numbers) return std::nullopt;
  if (!lower && !upper) {
    if (rate && *rate != 0) report("k_position is ignored without soft limits");
    return std::nullopt;
  }
  const char* fault = type == "continuous"    ? "the joint is continuous"
                      : !lower || !upper      ? "one of them is missing"
                      : !(*lower < *upper)    ? "they leave the joint no room to move"
                      : rate && !(*rate >= 0) ? "k_position is negative"
                                              : nullptr;
  if (!fault) {
    JointLimits limits{.soft_lower = *lower, .soft_upper = *upper};
    if (rate && *rate > 0) limits.soft_rate = *rate;
    return limits;
  }
  report("soft limits " + (lower ? rounded_text(*lower) : "(none)") + " .. " +
         (upper ? rounded_text(*upper) : "(none)") + " are ignored: " + fault);
  return std::nullopt;
}

/// The usable soft limits of a robot's joints, by name.
[[nodiscard]] inline std::map<std::string, JointLimits> read_soft_limits(const XmlElement& robot,
                                                                         NoticeList& notices) {
  std::map<std::string, JointLimits> all;
  for_each_child(robot, "joint", [&](const XmlElement& joint) {
    const XmlElement* safety = joint.FirstChildElement("safety_controller");
    const std::string name = attribute(joint, "name"), type = attribute(joint, "type");
    if (!safety || type == "fixed") return;
    const auto limits = soft_limits_of(*safety, type, [&](const std::string& text) {
      notices.add("joint '" + one_line(name) + "': ", "<safety_controller>: " + text);
    });
    if (limits) all[name] = *limits;
  });
  return all;
}

}  // namespace articula::detail
