// SPDX-License-Identifier: Apache-2.0
/// @file How fast, and how smoothly, the joints may be asked to move.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <string_view>

namespace articula {

/// The limits of a motion in either direction, for each of N joints.
/// @tparam N  number of joints
template <int N>
struct MotionLimits {
  JointVector<N> velocity = JointVector<N>::Zero();      ///< V [rad/s or m/s], N x 1
  JointVector<N> acceleration = JointVector<N>::Zero();  ///< A [rad/s^2 or m/s^2], N x 1
  JointVector<N> jerk = JointVector<N>::Zero();          ///< J [rad/s^3 or m/s^3], N x 1
};

/// The limits of a motion as fast as the robot's description allows. Most descriptions say nothing
/// of acceleration and jerk, so these are given here:
///
///     const auto limits = motion_limits(Q2d(), {10, 30}, {200, 600});
///
/// @param robot         its joints' limits of velocity are taken; a joint without one makes no
///                      motion that validate() accepts
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

/// Refuses limits that a profile cannot be computed with: each must lie between 1e-9 and 1e9, so
/// that powers and quotients of them neither overflow nor vanish. A velocity limit must not be
/// above that of the robot's joint either.
/// @throws std::invalid_argument naming limit, joint and value
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const MotionLimits<joint_count<R>>& limits) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
    const auto check = [&](std::string_view what, double value) {
      if (!is_finite(value) || value < 1e-9 || value > 1e9) {
        detail::refuse({"motion limits: ", what, " ", value, " of joint '", joint.name.view(),
                        "' is not between 1e-9 and 1e9"});
      }
    };
    check("velocity", limits.velocity[j]);
    check("acceleration", limits.acceleration[j]);
    check("jerk", limits.jerk[j]);
    if (limits.velocity[j] > joint.limits.velocity) {
      detail::refuse({"motion limits: velocity ", limits.velocity[j], " of joint '",
                      joint.name.view(), "' is above the joint's limit ", joint.limits.velocity});
    }
  }
}

}  // namespace articula
