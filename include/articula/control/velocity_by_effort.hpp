// SPDX-License-Identifier: Apache-2.0
/// @file Velocity control of each joint through its effort.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/pid_law.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <string_view>

namespace articula {

/// Velocity control of each joint: effort = clamp(PID + effort_ref), where the PID's error is
/// v_ref - v. Uses the reference's velocity and effort.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class VelocityByEffort : public SumController<R, EffortCommand<joint_count<R>, S>,
                                              PidLaw<joint_count<R>, PidOf::velocity, S>,
                                              EffortFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "velocity_by_effort";
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot  whose effort limits hold
  /// @param gains  proportional [N m s/rad or N s/m], integral [N m/rad or N/m],
  ///               derivative [kg m^2 or kg], clamps in N m or N
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  VelocityByEffort(const R& robot, const JointPidGains<joint_count>& gains)
      : VelocityByEffort::SumController(robot, {robot, gains}, {}) {}
  /// For a robot known at compile time.
  explicit VelocityByEffort(const JointPidGains<joint_count>& gains)
    requires DescribedRobot<R>
      : VelocityByEffort(R(), gains) {}
};

}  // namespace articula
