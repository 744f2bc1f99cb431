// SPDX-License-Identifier: Apache-2.0
/// @file Tolerances between a trajectory and the measured motion.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/reference/trajectory/trajectory_outcome.hpp"

#include <cmath>
#include <string>
#include <string_view>

namespace articula {

/// The largest deviations of N joints, in both directions. 0 is not checked. These are parameters
/// of ROS's joint trajectory controller: constraints.<joint>.trajectory, constraints.<joint>.goal,
/// constraints.stopped_velocity_tolerance and constraints.goal_time.
template <int N>
struct TrajectoryTolerances {
  JointVector<N> path_position = JointVector<N>::Zero();  ///< before the end [rad or m], N x 1
  JointVector<N> path_velocity = JointVector<N>::Zero();  ///< before the end [rad/s or m/s], N x 1
  JointVector<N> goal_position = JointVector<N>::Zero();  ///< at the end [rad or m], N x 1
  JointVector<N> stopped_velocity =
      JointVector<N>::Constant(0.01);  ///< at the end [rad/s or m/s], N x 1
  double goal_time = 0;                ///< time to arrive after the last point [s]; 0: unlimited
};

/// The first tolerance that is not a finite number >= 0; an empty refusal if there is none.
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

/// Checks that tolerances are valid.
/// @throws std::invalid_argument naming tolerance, joint and value
/// Real-time: no (throws).
template <Robot R>
void validate(const R& robot, const TrajectoryTolerances<joint_count<R>>& tolerances) {
  const std::string text = to_string(robot, refusal_of(tolerances));
  if (!text.empty()) detail::refuse({"tolerances: ", text});
}

/// Whether errors are within tolerances. A tolerance of 0 is not checked; NaN is out of tolerance.
/// Real-time: yes.
template <int N>
[[nodiscard]] bool within_tolerance(const JointVector<N>& error,
                                    const JointVector<N>& tolerance) noexcept {
  for (int j = 0; j < N; ++j) {
    const bool good = is_finite(error[j]) && std::abs(error[j]) <= tolerance[j];
    if (tolerance[j] > 0 && !good) return false;
  }
  return true;
}

/// The tolerances of a goal in combination with configured ones. A goal's 0 selects the configured
/// tolerance, -1 none. Other values that are negative or not finite stay, so that
/// refusal_of() finds them.
/// @param configured  tolerances of goals that bring none
/// @param goal        tolerances in the goal
/// Real-time: yes.
template <int N>
[[nodiscard]] TrajectoryTolerances<N> overridden(TrajectoryTolerances<N> configured,
                                                 const TrajectoryTolerances<N>& goal) noexcept {
  const auto put = [](double& value, double request) {
    if (request != 0) value = request == -1 ? 0 : request;
  };
  for (int j = 0; j < N; ++j) {
    put(configured.path_position[j], goal.path_position[j]);
    put(configured.path_velocity[j], goal.path_velocity[j]);
    put(configured.goal_position[j], goal.goal_position[j]);
    put(configured.stopped_velocity[j], goal.stopped_velocity[j]);
  }
  put(configured.goal_time, goal.goal_time);
  return configured;
}

}  // namespace articula
