// SPDX-License-Identifier: Apache-2.0
/// @file Limits of velocity, acceleration and jerk for planned motions.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace articula {

/// The limits of a planned motion, equal in both directions, for each of N joints.
template <int N>
struct MotionLimits {
  JointVector<N> velocity = JointVector<N>::Zero();      ///< V [rad/s or m/s], N x 1
  JointVector<N> acceleration = JointVector<N>::Zero();  ///< A [rad/s^2 or m/s^2], N x 1
  JointVector<N> jerk = JointVector<N>::Zero();          ///< J [rad/s^3 or m/s^3], N x 1
};

/// Motion limits with the velocities of the robot's description. Most descriptions have no limits
/// of acceleration and jerk, so the caller gives these:
///
///     const auto limits = motion_limits(Q2d(), {10, 30}, {200, 600});
///
/// @param robot         source of the velocity limits; validate() refuses a joint without one
/// @param acceleration  A [rad/s^2 or m/s^2], N x 1
/// @param jerk          J [rad/s^3 or m/s^3], N x 1
/// Real-time: yes.
template <Robot R>
[[nodiscard]] MotionLimits<joint_count<R>> motion_limits(
    const R& robot, const JointVector<joint_count<R>>& acceleration,
    const JointVector<joint_count<R>>& jerk) noexcept {
  const auto velocity = [](const JointProperties& joint) { return joint.limits.velocity; };
  return {joint_values(robot, velocity), acceleration, jerk};
}

namespace detail {

/// Refuses a limit whose size is not between 1e-9 and 1e9: powers and quotients of limits in this
/// range neither overflow nor vanish.
/// @param side  -1 for a lowest value, 1 for a highest one
inline void check_motion_limit(const JointProperties& joint, std::string_view what, double value,
                               double side = 1) {
  if (is_finite(value) && side * value >= 1e-9 && side * value <= 1e9) return;
  refuse({"motion limits: ", what, " ", value, " of joint '", joint.name.view(),
          "' is not between ", side < 0 ? "-1e9 and -1e-9" : "1e-9 and 1e9"});
}

/// Refuses a velocity above the limit of the robot's joint.
inline void check_motion_velocity(const JointProperties& joint, double velocity) {
  if (std::abs(velocity) <= joint.limits.velocity) return;
  refuse({"motion limits: velocity ", velocity, " of joint '", joint.name.view(),
          "' is above the joint's limit ", joint.limits.velocity});
}

}  // namespace detail

/// Checks limits for profiles: each lies between 1e-9 and 1e9, and no velocity is above the limit
/// of the robot's joint.
/// @throws std::invalid_argument naming limit, joint and value
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const MotionLimits<joint_count<R>>& limits) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    detail::check_motion_limit(joint, "velocity", limits.velocity[j]);
    detail::check_motion_limit(joint, "acceleration", limits.acceleration[j]);
    detail::check_motion_limit(joint, "jerk", limits.jerk[j]);
    detail::check_motion_velocity(joint, limits.velocity[j]);
  }
}

/// The limits of the motion of one joint, with a velocity and an acceleration for each direction.
struct MotionBounds {
  double lowest_velocity = 0;       ///< V- < 0 [rad/s or m/s]
  double highest_velocity = 0;      ///< V+ > 0 [rad/s or m/s]
  double lowest_acceleration = 0;   ///< A- < 0 [rad/s^2 or m/s^2]
  double highest_acceleration = 0;  ///< A+ > 0 [rad/s^2 or m/s^2]
  double jerk = 0;                  ///< J, in both directions [rad/s^3 or m/s^3]
};

/// Bounds of each joint from limits that are equal in both directions. Real-time: yes.
template <int N>
[[nodiscard]] JointArray<MotionBounds, N> both_ways(const MotionLimits<N>& limits) noexcept {
  JointArray<MotionBounds, N> bounds;
  for (int j = 0; j < N; ++j) {
    const double V = limits.velocity[j], A = limits.acceleration[j];
    bounds[j] = {-V, V, -A, A, limits.jerk[j]};
  }
  return bounds;
}

/// Checks bounds for StateToStateProfile:
///
/// - the size of each lies between 1e-9 and 1e9, the lowest ones are negative, the highest
///   positive;
/// - the bounds of the two directions differ by a factor of 100 at most;
/// - V J / A^2 lies between 1e-6 and 1e6, with the smaller bound of the two directions. It is the
///   time from rest to the velocity limit over the time from zero to the acceleration limit. A
///   jerk beyond this range makes no motion faster;
/// - a velocity is not above the limit of the robot's joint.
///
/// Tests cover random motions in this range, with V / A between 1e-4 s and 1e4 s. Beyond it,
/// rounding of double makes some motions exceed their limits.
/// @throws std::invalid_argument naming limit, joint and values
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const JointArray<MotionBounds, joint_count<R>>& bounds) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    const auto& [v_low, v_high, a_low, a_high, jerk] = bounds[j];
    detail::check_motion_limit(joint, "lowest velocity", v_low, -1);
    detail::check_motion_limit(joint, "highest velocity", v_high);
    detail::check_motion_limit(joint, "lowest acceleration", a_low, -1);
    detail::check_motion_limit(joint, "highest acceleration", a_high);
    detail::check_motion_limit(joint, "jerk", jerk);
    const auto check_directions = [&](std::string_view what, double lowest, double highest) {
      constexpr double most = 100;
      if (-lowest <= most * highest && highest <= -most * lowest) return;
      detail::refuse({"motion limits: lowest ", what, " ", lowest, " and highest ", what, " ",
                      highest, " of joint '", joint.name.view(),
                      "' differ more than 100 times in size"});
    };
    check_directions("velocity", v_low, v_high);
    check_directions("acceleration", a_low, a_high);
    const double V = std::min(-v_low, v_high), A = std::min(-a_low, a_high);
    const double ratio = V * jerk / A / A;
    if (!(ratio >= 1e-6 && ratio <= 1e6)) {
      detail::refuse({"motion limits: jerk ", jerk, " of joint '", joint.name.view(),
                      "' does not suit velocity ", V, " and acceleration ", A,
                      ": velocity * jerk / acceleration^2 is ", ratio,
                      ", not between 1e-6 and 1e6"});
    }
    detail::check_motion_velocity(joint, v_low);
    detail::check_motion_velocity(joint, v_high);
  }
}

}  // namespace articula
