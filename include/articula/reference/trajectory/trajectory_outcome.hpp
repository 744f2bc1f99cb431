// SPDX-License-Identifier: Apache-2.0
/// @file How a trajectory ended, or why it was refused.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace articula {

/// What became of a trajectory. The values from 0 down are the error codes of ROS's
/// FollowJointTrajectory action.
enum class TrajectoryOutcome : signed char {
  idle = 3,                      ///< There was none yet.
  canceled = 2,                  ///< It was canceled.
  active = 1,                    ///< It is being followed, or waits for its start.
  successful = 0,                ///< The joints arrived within the tolerances.
  invalid_goal = -1,             ///< A number or a size makes no sense.
  invalid_joints = -2,           ///< A joint is unknown, missing or named twice.
  old_header_timestamp = -3,     ///< None of its points lies ahead.
  path_tolerance_violated = -4,  ///< On the way, a joint left its tolerance.
  goal_tolerance_violated = -5,  ///< A joint did not arrive in time.
};

/// The outcome in words, for messages and logs.
/// Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(TrajectoryOutcome outcome) noexcept {
  switch (outcome) {
    case TrajectoryOutcome::idle:
      return "idle";
    case TrajectoryOutcome::canceled:
      return "canceled";
    case TrajectoryOutcome::active:
      return "active";
    case TrajectoryOutcome::successful:
      return "successful";
    case TrajectoryOutcome::invalid_goal:
      return "invalid goal";
    case TrajectoryOutcome::invalid_joints:
      return "invalid joints";
    case TrajectoryOutcome::old_header_timestamp:
      return "old header timestamp";
    case TrajectoryOutcome::path_tolerance_violated:
      return "path tolerance violated";
    case TrajectoryOutcome::goal_tolerance_violated:
      return "goal tolerance violated";
  }
  return "unknown outcome";
}

/// A trajectory that was refused at set-up: the message names point, joint, value and limit, the
/// outcome is the code that an action server answers with.
class TrajectoryError : public std::invalid_argument {
 public:
  TrajectoryError(TrajectoryOutcome outcome, const std::string& message)
      : std::invalid_argument("trajectory: " + message), outcome_(outcome) {}

  /// invalid_goal or invalid_joints.
  [[nodiscard]] TrajectoryOutcome outcome() const noexcept { return outcome_; }

 private:
  TrajectoryOutcome outcome_;
};

}  // namespace articula
