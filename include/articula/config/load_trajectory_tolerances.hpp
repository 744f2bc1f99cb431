// SPDX-License-Identifier: Apache-2.0
/// @file Loads the tolerances of trajectories from a file. Needs the CMake target articula::config
/// (yaml-cpp).
#pragma once

#include "articula/config/check_robot.hpp"
#include "articula/config/load_controller.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

/// A joint trajectory controller's parameters, and the tolerances of a robot with N joints.
template <int N>
struct TrajectoryConfig : ControllerConfig {
  TrajectoryTolerances<N> tolerances{};  ///< in the order of the robot's joints
};

/// Loads the constraints of ROS's joint trajectory controller:
///
///     const TrajectoryConfig<2> config = load_trajectory_tolerances(Q2d(), "controllers.yaml");
///     TrajectoryFollower<Q2d> follower(position, limits, {.tolerances = config.tolerances});
///
/// A joint that the file does not list, such as a gripper's, has no tolerances; `notes` names it.
/// @param source  a file, or a ConfigSource::text
/// @param name    of the controller; may be empty if one has constraints
/// @throws FileError with file, line, key and what was expected
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] TrajectoryConfig<joint_count<R>> load_trajectory_tolerances(
    const R& robot, const ConfigSource& source, std::string_view name = {}) {
  const detail::RobotJoints known = detail::joints_of(robot);
  ControllerConfig config = detail::load_controller(
      source, {name, "controller with constraints", detail::has_constraints}, &known);
  TrajectoryConfig<joint_count<R>> result;
  if (config.joints.empty()) detail::refuse_missing(config, robot, 0, "an entry in 'joints'");
  const auto joints = detail::arranged_joints(config, robot);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    if (joints[j] == nullptr) {
      result.tolerances.stopped_velocity[k] = 0;
      config.notes.push_back(config.place.text() + "no tolerances for joint '" + known.names[j] +
                             "', which is not in 'joints': it is not checked");
      continue;
    }
    result.tolerances.path_position[k] = joints[j]->path_tolerance;
    result.tolerances.goal_position[k] = joints[j]->goal_tolerance;
    result.tolerances.stopped_velocity[k] = config.stopped_velocity_tolerance;
  }
  result.tolerances.goal_time = config.goal_time;
  static_cast<ControllerConfig&>(result) = std::move(config);
  return result;
}

}  // namespace articula
