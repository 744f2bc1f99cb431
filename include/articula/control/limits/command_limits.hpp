// SPDX-License-Identifier: Apache-2.0
/// @file Limits of the commands to the joints.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

namespace articula {

/// The limits of one joint's motion (CommandLimits::of_joint), unlimited by default.
struct JointCommandLimits {
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  double lower = -infinity, upper = infinity;            ///< [rad or m]
  double soft_lower = -infinity, soft_upper = infinity;  ///< [rad or m]
  double soft_rate = infinity;                           ///< k [1/s]
  double velocity = infinity;                            ///< V [rad/s or m/s]
  double acceleration = 1e15;                            ///< A [rad/s^2 or m/s^2]
  double deceleration = 1e15;                            ///< B; above A, steps count it as A
  double jerk = 1e30;                                    ///< J [rad/s^3 or m/s^3]

  /// The limits that steps compute with. B is at most A. Unlimited acceleration and jerk are so
  /// large that they never limit, and their powers do not overflow. Real-time: yes.
  [[nodiscard]] JointCommandLimits bounded() const noexcept {
    JointCommandLimits limits = *this;
    limits.acceleration = std::min(acceleration, 1e15);
    limits.deceleration = std::min(deceleration, limits.acceleration);
    limits.jerk = std::min(jerk, 1e30);
    return limits;
  }
};

/// The limits of the commands to N joints, unlimited by default. `command_limits(robot)` returns
/// those of the robot's description.
/// @tparam N  number of joints
template <int N>
struct CommandLimits {
  /// N x 1
  using Vector = JointVector<N>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  Vector lower = Vector::Constant(-infinity);        ///< lowest position [rad or m], N x 1
  Vector upper = Vector::Constant(infinity);         ///< highest position [rad or m], N x 1
  Vector velocity = Vector::Constant(infinity);      ///< V, absolute value [rad/s or m/s], N x 1
  Vector acceleration = Vector::Constant(infinity);  ///< A, absolute [rad/s^2 or m/s^2], N x 1
  /// B <= A, the deceleration of planned stops before a position limit [rad/s^2 or m/s^2], N x 1.
  /// The rest up to A is a reserve. Infinite: B = A, for efforts 0.8 A.
  Vector deceleration = Vector::Constant(infinity);
  Vector jerk = Vector::Constant(infinity);         ///< J, absolute value [rad/s^3 or m/s^3], N x 1
  Vector effort = Vector::Constant(infinity);       ///< of the total, absolute [N m or N], N x 1
  Vector effort_rate = Vector::Constant(infinity);  ///< absolute value [N m/s or N/s], N x 1

  Vector soft_lower = Vector::Constant(-infinity);  ///< soft limit of position [rad or m], N x 1
  Vector soft_upper = Vector::Constant(infinity);   ///< likewise
  /// k: the highest velocity towards a soft limit at the distance x is k x, and 0 beyond the limit
  /// [1/s], N x 1. Infinite: limited by braking alone.
  Vector soft_rate = Vector::Constant(infinity);

  /// The limits of one joint's motion. Real-time: yes.
  [[nodiscard]] JointCommandLimits of_joint(int joint) const noexcept {
    const JointCommandLimits limits{lower[joint],        upper[joint],        soft_lower[joint],
                                    soft_upper[joint],   soft_rate[joint],    velocity[joint],
                                    acceleration[joint], deceleration[joint], jerk[joint]};
    return limits.bounded();
  }
};

/// The limits in a robot's description: position, velocity, effort, and optionally acceleration,
/// jerk and soft limits. Real-time: yes.
template <Robot R>
[[nodiscard]] CommandLimits<joint_count<R>> command_limits(const R& robot) noexcept {
  const auto of = [&](double JointLimits::* limit) {
    return joint_values(robot, [&](const JointProperties& joint) { return joint.limits.*limit; });
  };
  return {.lower = of(&JointLimits::lower),
          .upper = of(&JointLimits::upper),
          .velocity = of(&JointLimits::velocity),
          .acceleration = of(&JointLimits::acceleration),
          .jerk = of(&JointLimits::jerk),
          .effort = of(&JointLimits::effort),
          .soft_lower = of(&JointLimits::soft_lower),
          .soft_upper = of(&JointLimits::soft_upper),
          .soft_rate = of(&JointLimits::soft_rate)};
}

namespace detail {

/// The end of a message about limits beyond the description's. As CommandLimits are unlimited by
/// default, a list of a few limits lacks the others.
inline constexpr std::string_view within_description =
    " of the robot's description; begin with command_limits(robot) and change single limits";

}  // namespace detail

/// Checks that limits can be kept and do not exceed those of the robot's description.
/// @throws std::invalid_argument naming limit, joint, value and bound
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const CommandLimits<joint_count<R>>& limits) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
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
      if (lower < lowest)
        refuse({soft, "lower ", lower, " is below the limit ", lowest, detail::within_description});
      if (upper > highest)
        refuse(
            {soft, "upper ", upper, " is above the limit ", highest, detail::within_description});
    };
    const auto check = [&](std::string_view what, double value, double most,
                           std::string_view reason = detail::within_description) {
      if (!(value > 0)) refuse({what, " ", value, " is not a number > 0"});
      if (value > most) refuse({what, " ", value, " is above the limit ", most, reason});
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
    const bool has_deceleration = is_finite(limits.deceleration[j]);
    check("deceleration", limits.deceleration[j],
          has_deceleration ? limits.acceleration[j] : infinity, " of acceleration");
    check("jerk", limits.jerk[j], joint.limits.jerk);
    if (limits.effort[j] != 0) check("effort", limits.effort[j], joint.limits.effort);
    check("effort_rate", limits.effort_rate[j], infinity);
  }
}

}  // namespace articula
