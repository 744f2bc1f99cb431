// SPDX-License-Identifier: Apache-2.0
/// @file Trajectories with joints by name in any order, as in messages and files.
#pragma once

#include "articula/reference/trajectory/trajectory.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace articula {

/// One point with the members of trajectory_msgs/JointTrajectoryPoint. Each array is empty or has a
/// number for each joint.
struct NamedTrajectoryPoint {
  double time_from_start = 0;           ///< [s]
  std::vector<double> positions{};      ///< [rad or m]
  std::vector<double> velocities{};     ///< [rad/s or m/s]
  std::vector<double> accelerations{};  ///< [rad/s^2 or m/s^2]
  std::vector<double> effort{};         ///< [N m or N]
};

/// A trajectory with the members of trajectory_msgs/JointTrajectory.
struct NamedTrajectory {
  std::vector<std::string> joint_names{};
  std::vector<NamedTrajectoryPoint> points{};
};

/// The treatment of numbers that a named trajectory leaves out:
///
///     arrange(Ur10(), named, {.allow_partial_joints = true, .from = follower.reference()});
template <int N>
struct ArrangeOptions {
  TrajectoryOptions trajectory{};
  /// Joints that are not named are left out (Trajectory::leave_out): under a TrajectoryFollower
  /// they continue their present motion. In the points they stay at the position of `from`, or at
  /// the limit next to it. Otherwise a joint that is not named is an error.
  bool allow_partial_joints = false;
  /// Missing positions (and velocities) are integrated from velocities (and accelerations) by
  /// Heun's method, beginning at `from` at time 0. Otherwise missing positions are an error.
  bool allow_integration = false;
  /// The present reference; required for joints that are left out and for integration. Spline
  /// velocities begin there.
  std::optional<JointReference<N>> from{};
};

/// Arranges a named trajectory in the order of a robot's joints.
/// @tparam Capacity  largest number of points
/// @throws TrajectoryError: invalid_joints if a name is unknown or used twice, or a joint is not
///         named (or left out without `from`)
/// @throws TrajectoryError: invalid_goal if an array and the names differ in length, positions are
///         missing, or Trajectory refuses the result; messages name point and joint
///         where there is one
/// Real-time: no (throws, allocates).
template <int Capacity = 32, Robot R>
[[nodiscard]] Trajectory<R, Capacity> arrange(const R& robot, const NamedTrajectory& named,
                                              const ArrangeOptions<joint_count<R>>& options = {}) {
  constexpr int n = joint_count<R>;
  const auto refuse_joints = [](detail::MessageParts parts) {
    throw TrajectoryError(TrajectoryOutcome::invalid_joints, detail::message_of(parts));
  };
  const auto names = joint_names(robot);
  JointArray<std::optional<std::size_t>, n> column{};
  for (std::size_t c = 0; c < named.joint_names.size(); ++c) {
    const std::string& name = named.joint_names[c];
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      refuse_joints({detail::no_such_joint_text(model_of(robot), name)});
    }
    auto& own = column[found - names.begin()];
    if (own) refuse_joints({"joint '", name, "' is named twice"});
    own = c;
  }
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (column[j] || (options.allow_partial_joints && options.from)) continue;
    refuse_joints({"joint '", names[j], "' is not named",
                   options.allow_partial_joints ? "; set ArrangeOptions::from" : ""});
  }

  std::vector<TrajectoryPoint<n>> points;
  double time = 0;
  JointReference<n> from = options.from.value_or(JointReference<n>{});
  const JointVector<n> within = joint_range(robot).clamp(from.position);
  for (int j = 0; j < n; ++j) {  // a joint that is left out is none of this trajectory's concern
    if (!column[j]) set_motion(from, j, {within[j], 0, 0});
  }
  JointReference<n> last = from;
  for (std::size_t k = 0; k < named.points.size(); ++k) {
    const NamedTrajectoryPoint& source = named.points[k];
    const auto arranged = [&](const char* what, const std::vector<double>& values,
                              const JointVector<n>& others) -> std::optional<JointVector<n>> {
      if (values.empty()) return std::nullopt;
      if (values.size() != named.joint_names.size()) {
        detail::refuse_goal({"point ", k + 1, ": ", values.size(), " ", what, " for ",
                             named.joint_names.size(), " joints"});
      }
      JointVector<n> result = others;
      for (int j = 0; j < n; ++j) {
        if (column[j]) result[j] = values[*column[j]];
      }
      return result;
    };
    const JointVector<n> zero = JointVector<n>::Zero();
    TrajectoryPoint<n> point{.time_from_start = source.time_from_start};
    const auto position = arranged("positions", source.positions, from.position);
    point.velocity = arranged("velocities", source.velocities, zero);
    point.acceleration = arranged("accelerations", source.accelerations, zero);
    point.effort = arranged("efforts", source.effort, zero).value_or(zero);
    if (position) {
      point.position = *position;
    } else {
      if (!options.allow_integration || (!point.velocity && !point.acceleration)) {
        detail::refuse_goal({"point ", k + 1, " has no positions"});
      }
      if (k == 0 && !options.from) {
        detail::refuse_goal({"point 1 has no positions; set ArrangeOptions::from"});
      }
      const double half = (source.time_from_start - time) / 2;
      const auto integral = [&](const JointVector<n>& from_value, const JointVector<n>& rate_before,
                                const JointVector<n>& rate) {
        return for_each_joint<n>(
            [&](int j) noexcept { return from_value[j] + half * (rate_before[j] + rate[j]); });
      };
      if (!point.velocity) {
        point.velocity = integral(last.velocity, last.acceleration, *point.acceleration);
      }
      point.position = integral(last.position, last.velocity, *point.velocity);
    }
    time = source.time_from_start;
    last = at_point(point);
    points.push_back(point);
  }
  if (options.trajectory.spline_velocities && options.from && !points.empty() &&
      points.front().time_from_start > 0) {
    // The spline begins at `from`, which is no point of the trajectory.
    points.insert(points.begin(), {.position = from.position, .velocity = from.velocity});
    set_spline_velocities(std::span(points));
    points.erase(points.begin());
  }
  Trajectory<R, Capacity> trajectory(robot, points, options.trajectory);
  for (int j = 0; j < n; ++j) {
    if (!column[j]) trajectory.leave_out(j);
  }
  return trajectory;
}

}  // namespace articula
