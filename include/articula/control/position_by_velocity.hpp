// SPDX-License-Identifier: Apache-2.0
/// @file Position control through velocity drives.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/pid_law.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <string_view>

namespace articula {

/// Position control through velocity drives: velocity = clamp(PID + v_ref), see PidLaw, whose
/// output is a velocity here. Uses the reference's position and velocity.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class PositionByVelocity : public SumController<R, VelocityCommand<joint_count<R>, S>,
                                                PidLaw<joint_count<R>, PidOf::position, S>,
                                                VelocityFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "position_by_velocity";
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot  whose velocity limits hold
  /// @param gains  proportional [1/s], integral [1/s^2], derivative [1], clamps in rad/s or m/s
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  PositionByVelocity(const R& robot, const JointPidGains<joint_count>& gains)
      : PositionByVelocity::SumController(robot, {robot, gains}, {}) {}
  /// For a robot known at compile time.
  explicit PositionByVelocity(const JointPidGains<joint_count>& gains)
    requires DescribedRobot<R>
      : PositionByVelocity(R(), gains) {}
};

}  // namespace articula
