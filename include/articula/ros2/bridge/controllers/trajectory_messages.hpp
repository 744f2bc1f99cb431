// SPDX-License-Identifier: Apache-2.0
/// @file ROS trajectories as requests to a loop, and cycles of the loop as ROS messages.
#pragma once

#include "articula/remote/cycle.hpp"
#include "articula/remote/request.hpp"
#include "articula/remote/sheet/robot_sheet.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/node/ros_time.hpp"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace articula::ros2 {

using TrajectoryPointMessage = trajectory_msgs::msg::JointTrajectoryPoint<Jazzy>;
using TrajectoryMessage = trajectory_msgs::msg::JointTrajectory<Jazzy>;

/// Makes a request to a loop from a trajectory that a ROS program has sent, as MoveIt does:
///
///     remote::PlayTrajectory request = to_request(message, now);
///
/// It checks nothing: the loop checks joints, points and limits. A program without ROS makes a
/// remote::PlayTrajectory itself.
/// @param message  its stamp is the time of the start; the stamp 0 means at once
/// @param now      the present time of ROS, from which the delay counts
/// @param speed    seconds of the loop in one of ROS
/// Real-time: no (allocates).
template <class Layout>
[[nodiscard]] remote::PlayTrajectory to_request(
    const trajectory_msgs::msg::JointTrajectory<Layout>& message, std::chrono::nanoseconds now,
    double speed = 1) {
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
    request.delay = speed * std::chrono::duration<double>(stamp - now).count();
  }
  return request;
}

/// The tolerances of a ROS goal, as a request to a loop has them. Real-time: no (allocates).
template <class Layout>
[[nodiscard]] std::vector<remote::NamedTolerance> to_request(
    const std::vector<control_msgs::msg::JointTolerance<Layout>>& tolerances) {
  std::vector<remote::NamedTolerance> named;
  for (const auto& own : tolerances) named.push_back({own.name, own.position, own.velocity});
  return named;
}

/// Reference, measurement, error and command of some joints in one cycle, as ROS messages. A
/// controller's state topic and the feedback of its action contain them.
struct CyclePoints {
  TrajectoryPointMessage reference{}, measured{}, error{}, output{};
};

/// The points of a cycle for a controller's joints.
/// The error of a continuous joint is less than a half turn, as that of a
/// joint_trajectory_controller.
/// @param cycle   the loop's cycle
/// @param joints  indices of the joints in the vectors of the cycle
/// @param robot   the loop's
/// Real-time: no (allocates).
[[nodiscard]] inline CyclePoints points_of(const remote::Cycle& cycle,
                                           const std::vector<std::size_t>& joints,
                                           const remote::RobotSheet& robot) {
  const std::vector<std::string>& commands = robot.commands;
  CyclePoints points;
  for (const std::size_t j : joints) {
    const double q = cycle.reference_position[j], v = cycle.reference_velocity[j];
    points.reference.positions.push_back(q);
    points.reference.velocities.push_back(v);
    points.reference.accelerations.push_back(cycle.reference_acceleration[j]);
    points.measured.positions.push_back(cycle.position[j]);
    points.measured.velocities.push_back(cycle.velocity[j]);
    const double error = q - cycle.position[j];
    const bool turns = robot.joints[j].type == JointType::continuous;
    points.error.positions.push_back(turns ? std::remainder(error, 2 * std::numbers::pi) : error);
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
