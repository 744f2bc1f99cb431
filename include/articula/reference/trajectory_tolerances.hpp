// SPDX-License-Identifier: Apache-2.0
/// @file How closely a trajectory must be followed.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/model/robot.hpp"
#include "articula/reference/checks.hpp"

#include <string_view>

namespace articula {

/// How far N joints may be off, in either direction. 0 is not checked, as in ROS's joint trajectory
/// controller, whose parameters these are: constraints.<joint>.trajectory,
/// constraints.<joint>.goal, constraints.stopped_velocity_tolerance and constraints.goal_time.
/// @tparam N  number of joints
template <int N>
struct TrajectoryTolerances {
  JointVector<N> path_position = JointVector<N>::Zero();  ///< on the way [rad or m], N x 1
  JointVector<N> path_velocity = JointVector<N>::Zero();  ///< on the way [rad/s or m/s], N x 1
  JointVector<N> goal_position = JointVector<N>::Zero();  ///< at the end [rad or m], N x 1
  JointVector<N> stopped_velocity =
      JointVector<N>::Constant(0.01);  ///< at the end [rad/s or m/s], N x 1
  double goal_time = 0;  ///< time to arrive after the last point [s]; 0: as long as it takes
};

/// True if every tolerance is a finite number >= 0. Real-time: yes.
template <int N>
[[nodiscard]] bool is_valid(const TrajectoryTolerances<N>& tolerances) noexcept {
  const auto good = [](const JointVector<N>& v) { return is_finite(v) && v.minCoeff() >= 0; };
  return good(tolerances.path_position) && good(tolerances.path_velocity) &&
         good(tolerances.goal_position) && good(tolerances.stopped_velocity) &&
         is_finite(tolerances.goal_time) && tolerances.goal_time >= 0;
}

/// Refuses tolerances that are not valid.
/// @throws std::invalid_argument naming tolerance, joint and value
/// Real-time: no (throws).
template <Robot R>
void validate(const TrajectoryTolerances<joint_count<R>>& tolerances, const R& robot) {
  const auto check = [](std::string_view what, double value, const auto&... whose) {
    if (is_finite(value) && value >= 0) return;
    detail::refuse("tolerances: ", what, " ", value, whose..., " is not a number >= 0");
  };
  for (int j = 0; j < joint_count<R>; ++j) {
    const std::string_view name = joint_names(robot)[static_cast<std::size_t>(j)];
    check("path_position", tolerances.path_position[j], " of joint '", name, "'");
    check("path_velocity", tolerances.path_velocity[j], " of joint '", name, "'");
    check("goal_position", tolerances.goal_position[j], " of joint '", name, "'");
    check("stopped_velocity", tolerances.stopped_velocity[j], " of joint '", name, "'");
  }
  check("goal_time", tolerances.goal_time);
}

/// Tolerances that come with a goal, over those that are set: 0 leaves what is set, -1 means that
/// it is not checked. What else is negative or not finite stays, so that is_valid() finds it.
/// Real-time: yes.
template <int N>
[[nodiscard]] TrajectoryTolerances<N> overridden(TrajectoryTolerances<N> set,
                                                 const TrajectoryTolerances<N>& asked) noexcept {
  const auto put = [](double& value, double request) {
    if (request != 0) value = request == -1 ? 0 : request;
  };
  for (int j = 0; j < N; ++j) {
    put(set.path_position[j], asked.path_position[j]);
    put(set.path_velocity[j], asked.path_velocity[j]);
    put(set.goal_position[j], asked.goal_position[j]);
    put(set.stopped_velocity[j], asked.stopped_velocity[j]);
  }
  put(set.goal_time, asked.goal_time);
  return set;
}

}  // namespace articula
