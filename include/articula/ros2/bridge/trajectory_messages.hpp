// SPDX-License-Identifier: Apache-2.0
/// @file Trajectories of ROS messages as requests to a loop, and its cycles as points of them.
#pragma once

#include "articula/remote/cycle.hpp"
#include "articula/remote/request.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace articula::ros2 {

using TrajectoryPointMessage = trajectory_msgs::msg::JointTrajectoryPoint<Jazzy>;
using TrajectoryMessage = trajectory_msgs::msg::JointTrajectory<Jazzy>;

/// What a loop is asked for by a trajectory.
/// @param now  in ROS's time, from which a stamp counts. The stamp 0 means at once.
/// Real-time: no (allocates).
template <class Layout>
[[nodiscard]] remote::PlayTrajectory to_request(
    const trajectory_msgs::msg::JointTrajectory<Layout>& message, std::chrono::nanoseconds now) {
  remote::PlayTrajectory request;
  request.trajectory.joint_names = message.joint_names;
  for (const auto& point : message.points) {
    request.trajectory.points.push_back({.time_from_start = seconds_of(point.time_from_start),
                                         .positions = point.positions,
                                         .velocities = point.velocities,
                                         .accelerations = point.accelerations,
                                         .effort = point.effort});
  }
  const std::chrono::nanoseconds stamp = from_message(message.header.stamp);
  if (stamp.count() != 0) {
    request.delay = std::chrono::duration<double>(stamp - now).count();
  }
  return request;
}

/// The tolerances of a goal.
template <class Layout>
[[nodiscard]] std::vector<remote::NamedTolerance> to_request(
    const std::vector<control_msgs::msg::JointTolerance<Layout>>& tolerances) {
  std::vector<remote::NamedTolerance> named;
  for (const auto& own : tolerances) named.push_back({own.name, own.position, own.velocity});
  return named;
}

/// What some joints shall do, do, the difference, and what they are commanded, in a cycle.
struct CyclePoints {
  TrajectoryPointMessage reference{}, measured{}, error{}, output{};
};

/// @param cycle     of the loop
/// @param joints    indices into its vectors
/// @param commands  names of its commands, as RobotSheet::commands
/// Real-time: no (allocates).
[[nodiscard]] inline CyclePoints points_of(const remote::Cycle& cycle,
                                           const std::vector<std::size_t>& joints,
                                           const std::vector<std::string>& commands) {
  CyclePoints points;
  for (const std::size_t j : joints) {
    const double q = cycle.reference_position[j], v = cycle.reference_velocity[j];
    points.reference.positions.push_back(q);
    points.reference.velocities.push_back(v);
    points.reference.accelerations.push_back(cycle.reference_acceleration[j]);
    points.measured.positions.push_back(cycle.position[j]);
    points.measured.velocities.push_back(cycle.velocity[j]);
    points.error.positions.push_back(q - cycle.position[j]);
    points.error.velocities.push_back(v - cycle.velocity[j]);
    for (std::size_t k = 0; k < commands.size() && k < cycle.command.size(); ++k) {
      auto* const column = commands[k] == "position"   ? &points.output.positions
                           : commands[k] == "velocity" ? &points.output.velocities
                           : commands[k] == "effort"   ? &points.output.effort
                                                       : nullptr;
      if (column != nullptr) column->push_back(cycle.command[k][j]);
    }
  }
  return points;
}

}  // namespace articula::ros2
