// SPDX-License-Identifier: Apache-2.0
/// @file Reads the tolerances of trajectories from a file. Needs the CMake target articula::config
/// (yaml-cpp).
#pragma once

#include "articula/config/arrange_joints.hpp"
#include "articula/config/load_controller.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace articula {

/// A joint trajectory controller's parameters, with the tolerances of a robot of N joints.
template <int N>
struct TrajectoryConfig : ControllerConfig {
  TrajectoryTolerances<N> tolerances{};  ///< in the order of the robot's joints
};

/// Reads the constraints of ROS's joint trajectory controller:
///
///     const TrajectoryConfig<2> config = load_trajectory_tolerances(Q2d(), "controllers.yaml");
///     TrajectoryFollower<Q2d> follower(position, limits, {.tolerances = config.tolerances});
///
/// Joints that the file does not list, such as those of a gripper with a controller of its own, are
/// not checked, which is noted.
/// @param robot   whose joints they are
/// @param source  a file, or a ConfigSource::text
/// @param name    of the controller; need not be given where there is but one with constraints
/// @throws FileError with file, line, key and what was expected
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] TrajectoryConfig<joint_count<R>> load_trajectory_tolerances(
    const R& robot, const ConfigSource& source, std::string_view name = {}) {
  const detail::RobotJoints known = detail::joints_of(robot);
  ControllerConfig config = detail::load_controller(source, name, detail::has_constraints,
                                                    "controller with constraints", &known);
  TrajectoryConfig<joint_count<R>> result;
  if (config.joints.empty()) detail::refuse_missing(config, robot, 0, "an entry in 'joints'");
  const auto joints = detail::arranged_joints(config, robot);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    if (joints[j] == nullptr) {
      result.tolerances.stopped_velocity[k] = 0;
      config.notes.push_back(config.place.file + ":" + std::to_string(config.place.line) +
                             ": no tolerances for joint '" + known.names[j] +
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
