// SPDX-License-Identifier: Apache-2.0
/// @file Trajectories as messages and files have them: joints by name, in any order.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/reference/trajectory/trajectory.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace articula {

/// One point; the members are those of trajectory_msgs/JointTrajectoryPoint. Each array is empty or
/// has a number for each joint.
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

/// What is done about numbers that a named trajectory leaves out:
///
///     arrange(Ur10(), named, {.allow_partial_joints = true, .from = follower.reference()});
template <int N>
struct ArrangeOptions {
  TrajectoryOptions trajectory{};
  /// Joints that are not named are left out (Trajectory::leave_out): a TrajectoryFollower lets them
  /// go on with what they do, and in the points they stay at the position of `from`. Otherwise a
  /// joint that is not named is an error.
  bool allow_partial_joints = false;
  /// Positions (and velocities) that are not given are integrated from velocities (and
  /// accelerations) by Heun's method, from `from` on at time 0; otherwise they are missed.
  bool allow_integration = false;
  /// What the joints are asked for at present; has to be given where something is to stay or to be
  /// integrated. Spline velocities begin from there.
  std::optional<JointReference<N>> from{};
};

namespace detail {

/// The spline begins where the joints are asked to be at time 0, which is no point of it.
template <int N>
void set_spline_velocities_from(const TrajectoryPoint<N>& from,
                                std::vector<TrajectoryPoint<N>>& points) {
  points.insert(points.begin(), from);
  set_spline_velocities(std::span(points));
  points.erase(points.begin());
}

}  // namespace detail

/// Puts a named trajectory in the order of a robot's joints.
/// @tparam Capacity  most points there can be
/// @throws TrajectoryError: invalid_joints if a name is unknown or used twice, or a joint is not
///         named (nor `from` given, where it may stay); invalid_goal if an array has another length
///         than the names, positions are not given, or Trajectory refuses the rest; the message
///         names point and joint
/// Real-time: no (throws, allocates).
template <int Capacity = 32, Robot R>
[[nodiscard]] Trajectory<R, Capacity> arrange(const R& robot, const NamedTrajectory& named,
                                              const ArrangeOptions<joint_count<R>>& options = {}) {
  constexpr int n = joint_count<R>;
  const auto refuse = [](TrajectoryOutcome outcome, detail::MessageParts parts) {
    throw TrajectoryError(outcome, detail::message_of(parts));
  };
  const auto names = joint_names(robot);
  std::array<std::optional<std::size_t>, static_cast<std::size_t>(n)> column{};
  for (std::size_t c = 0; c < named.joint_names.size(); ++c) {
    const std::string& name = named.joint_names[c];
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      refuse(TrajectoryOutcome::invalid_joints,
             {detail::no_such_joint_text(model_of(robot), name)});
    }
    auto& mine = column[static_cast<std::size_t>(found - names.begin())];
    if (mine) refuse(TrajectoryOutcome::invalid_joints, {"joint '", name, "' is named twice"});
    mine = c;
  }
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (column[j] || (options.allow_partial_joints && options.from)) continue;
    refuse(TrajectoryOutcome::invalid_joints,
           {"joint '", names[j], "' is not named",
            options.allow_partial_joints ? "; give `from`" : ""});
  }

  std::vector<TrajectoryPoint<n>> points;
  double time = 0;
  const JointReference<n> from = options.from.value_or(JointReference<n>{});
  JointReference<n> last = from;
  for (std::size_t k = 0; k < named.points.size(); ++k) {
    const NamedTrajectoryPoint& given = named.points[k];
    const auto arranged = [&](const char* what, const std::vector<double>& values,
                              const JointVector<n>& others) -> std::optional<JointVector<n>> {
      if (values.empty()) return std::nullopt;
      if (values.size() != named.joint_names.size()) {
        refuse(TrajectoryOutcome::invalid_goal, {"point ", k + 1, ": ", values.size(), " ", what,
                                                 " for ", named.joint_names.size(), " joints"});
      }
      JointVector<n> result = others;
      for (int j = 0; j < n; ++j) {
        const auto& mine = column[static_cast<std::size_t>(j)];
        if (mine) result[j] = values[*mine];
      }
      return result;
    };
    const JointVector<n> zero = JointVector<n>::Zero();
    TrajectoryPoint<n> point{.time_from_start = given.time_from_start};
    const auto position = arranged("positions", given.positions, from.position);
    point.velocity = arranged("velocities", given.velocities, zero);
    point.acceleration = arranged("accelerations", given.accelerations, zero);
    point.effort = arranged("efforts", given.effort, zero).value_or(zero);
    if (position) {
      point.position = *position;
    } else {
      if (!options.allow_integration || (!point.velocity && !point.acceleration)) {
        refuse(TrajectoryOutcome::invalid_goal, {"point ", k + 1, " has no positions"});
      }
      if (k == 0 && !options.from) {
        refuse(TrajectoryOutcome::invalid_goal, {"point 1 has no positions; give `from`"});
      }
      const double half = (given.time_from_start - time) / 2;
      if (!point.velocity) {
        point.velocity = last.velocity + half * (last.acceleration + *point.acceleration);
      }
      point.position = last.position + half * (last.velocity + *point.velocity);
    }
    time = given.time_from_start;
    last = at_point(point);
    points.push_back(point);
  }
  if (options.trajectory.spline_velocities && options.from && !points.empty() &&
      points.front().time_from_start > 0) {
    JointVector<n> velocity = from.velocity;
    for (int j = 0; j < n; ++j) {
      if (!column[static_cast<std::size_t>(j)]) velocity[j] = 0;
    }
    detail::set_spline_velocities_from({.position = from.position, .velocity = velocity}, points);
  }
  Trajectory<R, Capacity> trajectory(robot, points, options.trajectory);
  for (int j = 0; j < n; ++j) {
    if (!column[static_cast<std::size_t>(j)]) trajectory.leave_out(j);
  }
  return trajectory;
}

}  // namespace articula
