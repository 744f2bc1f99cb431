// SPDX-License-Identifier: Apache-2.0
/// @file The tolerances of a controller's trajectories that bring none.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/remote/request.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::ros2 {

/// The constraints of a joint_trajectory_controller, by its parameters' names. 0 is not checked.
struct TrajectoryConstraints {
  /// Of one joint.
  struct Joint {
    double trajectory = 0;        ///< before the end [rad or m]
    double goal = 0;              ///< at the end [rad or m]
    double stopped_velocity = 0;  ///< at the end [rad/s or m/s]; in ROS one for all joints
  };

  double goal_time = 0;         ///< time to arrive after the last point [s]
  std::vector<Joint> joints{};  ///< in the order of the controller's joints

  /// Puts constraints where a request has no tolerance of its own.
  /// @param names  of the controller's joints
  /// Real-time: no (allocates).
  void complete(remote::PlayTrajectory& request, const std::vector<std::string>& names) const {
    const auto put = [](double& value, double own) {
      if (value == 0) value = own > 0 ? own : -1;  // -1: not that of the loop either
    };
    const auto of = [](std::vector<remote::NamedTolerance>& all,
                       const std::string& name) -> remote::NamedTolerance& {
      const auto found =
          std::find_if(all.begin(), all.end(), [&](const auto& own) { return own.joint == name; });
      return found == all.end() ? all.emplace_back(remote::NamedTolerance{.joint = name}) : *found;
    };
    for (std::size_t j = 0; j < joints.size(); ++j) {
      put(of(request.path_tolerances, names[j]).position, joints[j].trajectory);
      auto& at_goal = of(request.goal_tolerances, names[j]);
      put(at_goal.position, joints[j].goal);
      put(at_goal.velocity, joints[j].stopped_velocity);
    }
    put(request.goal_time, goal_time);
  }
};

/// Refuses constraints that are not finite numbers >= 0.
/// @param controller  its name, for the message
/// @throws std::invalid_argument naming controller, constraint and value
/// Real-time: no (throws).
inline void validate(std::string_view controller, const TrajectoryConstraints& constraints) {
  const auto check = [&](std::string_view name, double value) {
    if (is_finite(value) && value >= 0) return;
    articula::detail::refuse({"ros2: constraint ", name, " of '", controller, "': ", value,
                              " is not a finite number >= 0"});
  };
  check("goal_time", constraints.goal_time);
  for (const TrajectoryConstraints::Joint& joint : constraints.joints) {
    check("trajectory", joint.trajectory);
    check("goal", joint.goal);
    check("stopped_velocity", joint.stopped_velocity);
  }
}

}  // namespace articula::ros2
