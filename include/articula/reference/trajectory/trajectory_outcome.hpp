// SPDX-License-Identifier: Apache-2.0
/// @file The outcome of a trajectory, and the reasons for which one is refused.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula {

/// The outcome of a trajectory. The values from 0 down are the error codes of ROS's
/// FollowJointTrajectory action.
enum class TrajectoryOutcome : signed char {
  idle = 3,                      ///< no trajectory was started
  canceled = 2,                  ///< canceled by the user
  active = 1,                    ///< being followed, or waiting for its start
  successful = 0,                ///< the joints arrived within the tolerances
  invalid_goal = -1,             ///< a number or a size is invalid
  invalid_joints = -2,           ///< a joint is unknown, missing or named twice
  old_header_timestamp = -3,     ///< all of its points lie in the past
  path_tolerance_violated = -4,  ///< a joint left its tolerance before the last point
  goal_tolerance_violated = -5,  ///< a joint did not arrive in time
};

/// The outcome in words, for messages and logs. Real-time: yes.
[[nodiscard]] constexpr std::string_view to_string(TrajectoryOutcome outcome) noexcept {
  constexpr std::array<std::string_view, 9> names{"goal tolerance violated",
                                                  "path tolerance violated",
                                                  "old header timestamp",
                                                  "invalid joints",
                                                  "invalid goal",
                                                  "successful",
                                                  "active",
                                                  "canceled",
                                                  "idle"};
  const int index = static_cast<int>(outcome) + 5;
  return index >= 0 && index < 9 ? names[static_cast<std::size_t>(index)] : "unknown outcome";
}

/// Thrown for an invalid trajectory at set-up. The message names point, joint, value and limit. The
/// outcome is the answer of an action server.
class TrajectoryError : public std::invalid_argument {
 public:
  TrajectoryError(TrajectoryOutcome outcome, const std::string& message)
      : std::invalid_argument("trajectory: " + message), outcome_(outcome) {}

  /// invalid_goal or invalid_joints.
  [[nodiscard]] TrajectoryOutcome outcome() const noexcept { return outcome_; }

 private:
  TrajectoryOutcome outcome_;
};

/// The reason for which a trajectory was refused: a value and the rule that it violates. The texts
/// are literals, so that the control loop can create and copy it.
struct TrajectoryRefusal {
  std::string_view what{};  ///< name of the value, such as "path_position"; empty: not refused
  double value = 0;         ///< in SI units
  int joint = -1;           ///< index of the joint; -1: not of a single joint
  std::string_view rule{};  ///< the violated rule, such as "is not a number >= 0"
  std::optional<double> limit{};  ///< the limit in the rule, if there is one
};

/// The refusal in one line: `path_position -1 of joint 'elbow' is not a number >= 0`. Empty if
/// nothing was refused.
/// Real-time: no (allocates).
template <Robot R>
[[nodiscard]] std::string to_string(const R& robot, const TrajectoryRefusal& refusal) {
  if (refusal.what.empty()) return {};
  std::string text = detail::message_of({refusal.what, " ", refusal.value});
  if (refusal.joint >= 0) {
    const JointProperties& joint = model_of(robot).joints[refusal.joint];
    text += detail::message_of({" of joint '", joint.name.view(), "'"});
  }
  text += detail::message_of({" ", refusal.rule});
  if (refusal.limit) text += detail::message_of({" ", *refusal.limit});
  return text;
}

namespace detail {

/// @throws TrajectoryError (invalid_goal) with the parts as its message
[[noreturn, gnu::cold]] inline void refuse_goal(MessageParts parts) {
  throw TrajectoryError(TrajectoryOutcome::invalid_goal, message_of(parts));
}

}  // namespace detail
}  // namespace articula
