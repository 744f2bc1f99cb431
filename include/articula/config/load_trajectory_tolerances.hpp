// SPDX-License-Identifier: Apache-2.0
/// @file Loads the tolerances of trajectories from a file. Needs the CMake target articula::config
/// (yaml-cpp).
#pragma once

#include "articula/config/load_controller.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/reference/trajectory/trajectory_tolerances.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
  for (int j = 0; j < joint_count<R>; ++j) {
    if (joints[j] == nullptr) {
      result.tolerances.stopped_velocity[j] = 0;
      config.notes.push_back(config.place.text() + "no tolerances for joint '" +
                             std::string(model_of(robot).joints[j].name.view()) +
                             "', which is not in 'joints': it is not checked");
      continue;
    }
    result.tolerances.path_position[j] = joints[j]->path_tolerance;
    result.tolerances.goal_position[j] = joints[j]->goal_tolerance;
    result.tolerances.stopped_velocity[j] = config.stopped_velocity_tolerance;
  }
  result.tolerances.goal_time = config.goal_time;
  static_cast<ControllerConfig&>(result) = std::move(config);
  return result;
}

/// The tolerances of a robot that several controllers of a file move. Each joint has those of the
/// first controller that lists it. goal_time is the first one. Without names a trajectory has
/// succeeded when its reference has arrived.
/// @param names  of the controllers, each of which has constraints
/// @throws FileError as load_trajectory_tolerances
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] TrajectoryTolerances<joint_count<R>> load_all_tolerances(
    const R& robot, const ConfigSource& source, const std::vector<std::string>& names) {
  constexpr int n = joint_count<R>;
  TrajectoryTolerances<n> all{.stopped_velocity = JointVector<n>::Zero()};
  JointArray<bool, n> has{};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const TrajectoryConfig<n> own = load_trajectory_tolerances(robot, source, names[k]);
    for (const ConfiguredJoint& joint : own.joints) {
      const int j = joint_index(robot, joint.name);
      if (std::exchange(has[j], true)) continue;
      all.path_position[j] = own.tolerances.path_position[j];
      all.goal_position[j] = own.tolerances.goal_position[j];
      all.stopped_velocity[j] = own.tolerances.stopped_velocity[j];
    }
    if (k == 0) all.goal_time = own.tolerances.goal_time;
  }
  return all;
}

}  // namespace articula
