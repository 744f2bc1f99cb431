// SPDX-License-Identifier: Apache-2.0
/// @file The check of the names and numbers of a request.
#pragma once

#include "articula/control/switching/switch_board.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/name.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/remote/request.hpp"
#include "articula/remote/sheet/robot_sheet.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::remote {

/// Checks names and numbers of requests against a robot. All functions that check throw
/// std::invalid_argument, naming joint, value and limit.
template <Robot R>
class RequestCheck {
 public:
  /// @param robot  stays where it is
  explicit RequestCheck(const R& robot) : robot_(robot) {}

  [[nodiscard]] const JointLimits& limits_of(int joint) const {
    return model_of(robot_).joints[joint].limits;
  }
  [[nodiscard]] std::string_view name_of(int joint) const {
    return model_of(robot_).joints[joint].name.view();
  }

  /// A name that a Name can hold.
  [[nodiscard]] static Name checked_name(const std::string& name) {
    if (name.size() > Name::capacity || name.find('\0') != std::string::npos) {
      articula::detail::refuse(
          {"a name has at most ", Name::capacity, " characters, none of them NUL"});
    }
    return name;
  }
  [[nodiscard]] static ControllerNames checked_names(const std::vector<std::string>& names) {
    if (names.size() > ControllerNames::capacity) {
      articula::detail::refuse(
          {names.size(), " controllers are more than ", ControllerNames::capacity});
    }
    std::vector<Name> checked;
    for (const std::string& name : names) checked.push_back(checked_name(name));
    return ControllerNames(std::span<const Name>(checked));
  }

  /// The joints and their numbers, each joint once.
  [[nodiscard]] std::vector<std::pair<int, double>> numbers(
      std::string_view what, const std::vector<JointValue>& values) const {
    std::vector<std::pair<int, double>> found;
    for (const JointValue& own : values) {
      const int joint = joint_index(robot_, own.joint);
      for (const auto& [other, value] : found) {
        if (other == joint)
          articula::detail::refuse({what, ": joint '", own.joint, "' is named twice"});
      }
      found.emplace_back(joint, own.value);
    }
    return found;
  }

  void check_position(std::string_view what, int joint, double value) const {
    const JointLimits& limits = limits_of(joint);
    if (is_finite(value) && value >= limits.lower && value <= limits.upper) return;
    const std::string unit = unit_of("position", joint);
    articula::detail::refuse({what, ": position ", value, " ", unit, " of joint '", name_of(joint),
                              "' is not within ", limits.lower, " .. ", limits.upper, " ", unit});
  }
  /// @param quantity  "velocity" or "effort"
  void check_size(std::string_view what, std::string_view quantity, int joint, double value,
                  double limit) const {
    if (is_finite(value) && std::abs(value) <= limit) return;
    const std::string unit = unit_of(quantity, joint);
    articula::detail::refuse({what, ": ", quantity, " ", value, " ", unit, " of joint '",
                              name_of(joint), "' is not within ", -limit, " .. ", limit, " ",
                              unit});
  }

  /// The efforts of a trajectory's points.
  void check_efforts(const NamedTrajectory& trajectory) const {
    for (std::size_t k = 0; k < trajectory.joint_names.size(); ++k) {
      for (int j = 0; j < joint_count<R>; ++j) {
        if (trajectory.joint_names[k] != name_of(j)) continue;
        for (const NamedTrajectoryPoint& point : trajectory.points) {
          if (k >= point.effort.size()) continue;
          check_size("trajectory", "effort", j, point.effort[k], limits_of(j).effort);
        }
      }
    }
  }
  /// The positions to which signals move a joint. A joint outside its limits may come back.
  /// @param around   the position to which they are added
  /// @param lowest   the least that they add
  /// @param highest  the most
  void check_signals(int joint, double around, double lowest, double highest) const {
    constexpr double rounding = 1e-9;  // of the present position
    if (highest > 0 && around + highest > limits_of(joint).upper + rounding) {
      check_position("signals", joint, around + highest);
    }
    if (lowest < 0 && around + lowest < limits_of(joint).lower - rounding) {
      check_position("signals", joint, around + lowest);
    }
  }

 private:
  [[nodiscard]] std::string unit_of(std::string_view quantity, int joint) const {
    const SheetJoint own{.type = model_of(robot_).joints[joint].type};
    if (quantity == "effort") return own.effort_unit();
    return own.position_unit() + (quantity == "velocity" ? "/s" : "");
  }

  const R& robot_;
};

}  // namespace articula::remote
