// SPDX-License-Identifier: Apache-2.0
/// @file How closely a trajectory must be followed.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/reference/trajectory/trajectory_refusal.hpp"

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

/// The first tolerance that is not a finite number >= 0; nothing, if there is none.
/// Real-time: yes.
template <int N>
[[nodiscard]] TrajectoryRefusal refusal_of(const TrajectoryTolerances<N>& tolerances) noexcept {
  TrajectoryRefusal refusal;
  const auto check = [&](std::string_view what, double value, int joint) {
    if ((is_finite(value) && value >= 0) || !refusal.what.empty()) return;
    refusal = {.what = what, .value = value, .joint = joint, .rule = "is not a number >= 0"};
  };
  for (int j = 0; j < N; ++j) {
    check("path_position", tolerances.path_position[j], j);
    check("path_velocity", tolerances.path_velocity[j], j);
    check("goal_position", tolerances.goal_position[j], j);
    check("stopped_velocity", tolerances.stopped_velocity[j], j);
  }
  check("goal_time", tolerances.goal_time, -1);
  return refusal;
}

/// True if every tolerance is a finite number >= 0. Real-time: yes.
template <int N>
[[nodiscard]] bool is_valid(const TrajectoryTolerances<N>& tolerances) noexcept {
  return refusal_of(tolerances).what.empty();
}

/// Refuses tolerances that are not valid.
/// @throws std::invalid_argument naming tolerance, joint and value
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const TrajectoryTolerances<joint_count<R>>& tolerances) {
  const std::string text = to_string(robot, refusal_of(tolerances));
  if (!text.empty()) detail::refuse({"tolerances: ", text});
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
