// SPDX-License-Identifier: Apache-2.0
/// @file What the joints may be commanded to do.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <limits>
#include <string_view>

namespace articula {

/// What N joints may be commanded to do. What is not given is unlimited; `command_limits(robot)`
/// gives what the robot's description says.
/// @tparam N  number of joints
template <int N>
struct CommandLimits {
  /// N x 1
  using Vector = JointVector<N>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Vector lower = Vector::Constant(-infinity);        ///< lowest position [rad or m], N x 1
  Vector upper = Vector::Constant(infinity);         ///< highest position [rad or m], N x 1
  Vector velocity = Vector::Constant(infinity);      ///< V, either way [rad/s or m/s], N x 1
  Vector acceleration = Vector::Constant(infinity);  ///< A, either way [rad/s^2 or m/s^2], N x 1
  /// B, what braking counts on where a joint must stop before a position limit, at most A; what is
  /// between B and A is in reserve [rad/s^2 or m/s^2], N x 1; infinite: A, for efforts 0.8 A
  Vector deceleration = Vector::Constant(infinity);
  Vector jerk = Vector::Constant(infinity);         ///< J, either way [rad/s^3 or m/s^3], N x 1
  Vector effort = Vector::Constant(infinity);       ///< of the total, either way [N m or N], N x 1
  Vector effort_rate = Vector::Constant(infinity);  ///< either way [N m/s or N/s], N x 1

  Vector soft_lower = Vector::Constant(-infinity);  ///< soft limit of position [rad or m], N x 1
  Vector soft_upper = Vector::Constant(infinity);   ///< likewise
  /// k: towards a soft limit at a distance x, the speed is at most k x; beyond it, 0 [1/s], N x 1;
  /// infinite: as fast as the joint can still brake before it
  Vector soft_rate = Vector::Constant(infinity);
};

/// The limits in a robot's description: position, velocity, effort, and where they are given
/// acceleration, jerk and soft limits. Real-time: yes.
template <Robot R>
[[nodiscard]] CommandLimits<joint_count<R>> command_limits(const R& robot) noexcept {
  const auto of = [&](double JointLimits::* limit) {
    return joint_values(robot, [&](const JointProperties& joint) { return joint.limits.*limit; });
  };
  CommandLimits<joint_count<R>> limits;
  limits.lower = of(&JointLimits::lower);
  limits.upper = of(&JointLimits::upper);
  limits.velocity = of(&JointLimits::velocity);
  limits.acceleration = of(&JointLimits::acceleration);
  limits.jerk = of(&JointLimits::jerk);
  limits.effort = of(&JointLimits::effort);
  limits.soft_lower = of(&JointLimits::soft_lower);
  limits.soft_upper = of(&JointLimits::soft_upper);
  limits.soft_rate = of(&JointLimits::soft_rate);
  return limits;
}

/// Refuses limits that cannot be kept or go beyond what the robot's description says.
/// @throws std::invalid_argument naming limit, joint, value and what it was compared with
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const CommandLimits<joint_count<R>>& limits) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
    const auto refuse = [&](detail::MessageParts parts) {
      detail::refuse(
          {"command limits of joint '", joint.name.view(), "': ", detail::message_of(parts)});
    };
    const auto check_range = [&](std::string_view soft, double lower, double upper, double lowest,
                                 double highest) {
      if (!(lower <= upper) || lower == CommandLimits<1>::infinity ||
          upper == -CommandLimits<1>::infinity) {
        refuse({soft, "lower ", lower, " and ", soft, "upper ", upper, " leave no position"});
      }
      if (lower < lowest) refuse({soft, "lower ", lower, " is below the limit ", lowest});
      if (upper > highest) refuse({soft, "upper ", upper, " is above the limit ", highest});
    };
    const auto check = [&](std::string_view what, double value, double most) {
      if (!(value > 0)) refuse({what, " ", value, " is not a number > 0"});
      if (value > most) refuse({what, " ", value, " is above the limit ", most});
    };
    constexpr double infinity = CommandLimits<1>::infinity;
    check_range("", limits.lower[j], limits.upper[j], joint.limits.lower, joint.limits.upper);
    check_range("soft_", limits.soft_lower[j], limits.soft_upper[j], -infinity, infinity);
    if (!(limits.soft_lower[j] <= limits.upper[j] && limits.soft_upper[j] >= limits.lower[j])) {
      refuse({"soft_lower ", limits.soft_lower[j], " and soft_upper ", limits.soft_upper[j],
              " are beyond the limits ", limits.lower[j], " .. ", limits.upper[j]});
    }
    check("soft_rate", limits.soft_rate[j], infinity);
    if (limits.velocity[j] != 0) check("velocity", limits.velocity[j], joint.limits.velocity);
    check("acceleration", limits.acceleration[j], joint.limits.acceleration);
    const bool reckons = is_finite(limits.deceleration[j]);
    check("deceleration", limits.deceleration[j], reckons ? limits.acceleration[j] : infinity);
    check("jerk", limits.jerk[j], joint.limits.jerk);
    if (limits.effort[j] != 0) check("effort", limits.effort[j], joint.limits.effort);
    check("effort_rate", limits.effort_rate[j], infinity);
  }
}

}  // namespace articula
