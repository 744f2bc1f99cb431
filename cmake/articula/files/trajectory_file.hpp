// SPDX-License-Identifier: Apache-2.0
/// @file Trajectories from files, as ROS writes them.
#pragma once

#include "program.hpp"

#include <string>

namespace terminal {

/// Reads a trajectory_msgs/JointTrajectory in YAML or JSON, alone or below the key "trajectory", as
/// in a goal of FollowJointTrajectory. Times are seconds, {sec, nanosec} or {secs, nsecs}.
/// @return the request of the service /play_trajectory, with times in seconds
/// @throws articula::FileError with file, line, key and what was expected
[[nodiscard]] Json read_trajectory_file(const std::string& file);

/// The time of the last point [s].
[[nodiscard]] double duration_of(const Json& trajectory);

}  // namespace terminal
