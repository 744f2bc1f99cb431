// SPDX-License-Identifier: Apache-2.0
/// @file Limits of a motion that differ between the directions.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/motion/motion_limits.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace articula {

/// The limits of one joint's motion. Velocity and acceleration have a limit in either direction.
struct MotionBounds {
  double lowest_velocity = 0;       ///< V- < 0 [rad/s or m/s]
  double highest_velocity = 0;      ///< V+ > 0 [rad/s or m/s]
  double lowest_acceleration = 0;   ///< A- < 0 [rad/s^2 or m/s^2]
  double highest_acceleration = 0;  ///< A+ > 0 [rad/s^2 or m/s^2]
  double jerk = 0;                  ///< J, either way [rad/s^3 or m/s^3]
};

/// The limits of the motion of N joints, where those of the directions differ. MotionLimits, which
/// are the same either way, become such limits by themselves.
/// @tparam N  number of joints
template <int N>
struct DirectedLimits {
  JointVector<N> lowest_velocity = JointVector<N>::Zero();       ///< V- < 0, N x 1
  JointVector<N> highest_velocity = JointVector<N>::Zero();      ///< V+ > 0, N x 1
  JointVector<N> lowest_acceleration = JointVector<N>::Zero();   ///< A- < 0, N x 1
  JointVector<N> highest_acceleration = JointVector<N>::Zero();  ///< A+ > 0, N x 1
  JointVector<N> jerk = JointVector<N>::Zero();                  ///< J, N x 1

  /// Those of one joint. Real-time: yes.
  [[nodiscard]] MotionBounds of(int joint) const noexcept {
    return {lowest_velocity[joint], highest_velocity[joint], lowest_acceleration[joint],
            highest_acceleration[joint], jerk[joint]};
  }
};

/// Limits that are the same either way. Real-time: yes.
template <int N>
[[nodiscard]] DirectedLimits<N> both_ways(const MotionLimits<N>& limits) noexcept {
  return {-limits.velocity, limits.velocity, -limits.acceleration, limits.acceleration,
          limits.jerk};
}

/// Refuses limits that no motion can be computed with:
///
/// - the size of each must lie between 1e-9 and 1e9, the lowest ones be negative and the highest
///   ones positive;
/// - the limits of the two directions must differ 100 times at most;
/// - V J / A^2 must lie between 1e-6 and 1e6, with the smaller limits of the two directions. It is
///   the time in which the acceleration brings the joint to its velocity, over that in which the
///   jerk brings it to its acceleration. A jerk beyond this range makes no motion faster.
///
/// Random motions in this range are tested, with V / A between 1e-4 s and 1e4 s. Beyond it, rounding
/// of double makes some motions pass their limits. A velocity must not be above the limit of the robot's joint.
/// @throws std::invalid_argument naming limit, joint and values
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const DirectedLimits<joint_count<R>>& limits) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
    const auto check = [&](std::string_view what, double value, double side) {
      if (is_finite(value) && side * value >= 1e-9 && side * value <= 1e9) return;
      detail::refuse({"motion limits: ", what, " ", value, " of joint '", joint.name.view(),
                      "' is not between ", side < 0 ? "-1e9 and -1e-9" : "1e-9 and 1e9"});
    };
    const MotionBounds bounds = limits.of(j);
    check("lowest velocity", bounds.lowest_velocity, -1);
    check("highest velocity", bounds.highest_velocity, 1);
    check("lowest acceleration", bounds.lowest_acceleration, -1);
    check("highest acceleration", bounds.highest_acceleration, 1);
    check("jerk", bounds.jerk, 1);
    const auto check_directions = [&](std::string_view what, double lowest, double highest) {
      constexpr double most = 100;
      if (-lowest <= most * highest && highest <= -most * lowest) return;
      detail::refuse({"motion limits: lowest ", what, " ", lowest, " and highest ", what, " ",
                      highest, " of joint '", joint.name.view(),
                      "' differ more than 100 times in size"});
    };
    check_directions("velocity", bounds.lowest_velocity, bounds.highest_velocity);
    check_directions("acceleration", bounds.lowest_acceleration, bounds.highest_acceleration);
    const double V = std::min(-bounds.lowest_velocity, bounds.highest_velocity);
    const double A = std::min(-bounds.lowest_acceleration, bounds.highest_acceleration);
    const double ratio = V * bounds.jerk / A / A;
    if (!(ratio >= 1e-6 && ratio <= 1e6)) {
      detail::refuse({"motion limits: jerk ", bounds.jerk, " of joint '", joint.name.view(),
                      "' does not suit velocity ", V, " and acceleration ", A,
                      ": velocity * jerk / acceleration^2 is ", ratio,
                      ", not between 1e-6 and 1e6"});
    }
    for (const double velocity : {bounds.lowest_velocity, bounds.highest_velocity}) {
      if (std::abs(velocity) <= joint.limits.velocity) continue;
      detail::refuse({"motion limits: velocity ", velocity, " of joint '", joint.name.view(),
                      "' is above the joint's limit ", joint.limits.velocity});
    }
  }
}

}  // namespace articula
