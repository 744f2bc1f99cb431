// SPDX-License-Identifier: Apache-2.0
/// @file PID control of each joint.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/pid_law.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <initializer_list>
#include <string_view>

namespace articula {

/// PID control of each joint: effort = clamp(PID + effort_ref), see PidLaw.
/// Uses the reference's position, velocity and effort.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class Pid : public SumController<R, EffortCommand<joint_count<R>, S>,
                                 PidLaw<joint_count<R>, PidOf::position, S>,
                                 EffortFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "pid";
  static constexpr int joint_count = articula::joint_count<R>;

  /// With the gains that the robot brings along.
  Pid()
    requires HasPidGains<R>
      : Pid(R::pid_gains) {}

  /// @param gains  JointPidGains<N>, or JointPidGains<N, S> with gains of each lane
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  template <PidGainsFor<joint_count, S> Gains = JointPidGains<joint_count>>
  Pid(const R& robot, const Gains& gains) : Pid::SumController(robot, {robot, gains}, {}) {}
  /// For a robot known at compile time.
  template <PidGainsFor<joint_count, S> Gains>
  explicit Pid(const Gains& gains)
    requires DescribedRobot<R>
      : Pid(R(), gains) {}
  /// With a list in place: `Pid<Q2d>({{.proportional = 5}, {.proportional = 6}})`.
  /// @throws std::invalid_argument as above, and if the list is not as long as there are joints
  Pid(std::initializer_list<PidGains> gains)  // NOLINT: a list is the gains
    requires DescribedRobot<R>
      : Pid(R(), pid_gains_of<joint_count>(gains)) {}
};

}  // namespace articula
