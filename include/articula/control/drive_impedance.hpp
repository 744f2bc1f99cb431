// SPDX-License-Identifier: Apache-2.0
/// @file Joint impedance control in the drives.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/gravity_compensation.hpp"
#include "articula/control/laws/impedance_gains.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <string_view>

namespace articula {

/// Joint impedance control closed in the drives, at their own rate. They get K, D, q_ref and v_ref,
/// and the effort clamp(g(q) + effort_ref) to add. The counterpart of JointImpedance for drives
/// that take a MultiModeCommand. Uses the reference's position, velocity and effort.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class DriveImpedance {
 public:
  static constexpr std::string_view name = "drive_impedance";
  static constexpr int joint_count = articula::joint_count<R>;
  using Scalar = S;

  /// @param robot  whose weight is carried and whose effort limits hold for what is added
  /// @param gains  of each joint
  /// @throws std::invalid_argument naming joint, gain and value, see validate
  DriveImpedance(const R& robot, const JointImpedanceGains<joint_count>& gains)
      : gains_(gains, joint_names(robot)), added_(robot, GravityCompensation<R, S>(robot), {}) {}
  /// For a robot known at compile time.
  explicit DriveImpedance(const JointImpedanceGains<joint_count>& gains)
    requires DescribedRobot<R>
      : DriveImpedance(R(), gains) {}

  /// The springs, dampers and efforts for the coming period. Real-time: yes.
  [[nodiscard]] MultiModeCommand<joint_count, S> update(
      const ControlInput<joint_count, S>& in) noexcept {
    MultiModeCommand<joint_count, S> command{.position = in.reference.position,
                                             .velocity = in.reference.velocity};
    for (int j = 0; j < joint_count; ++j) {
      command.stiffness[j] = gains_[j].stiffness;
      command.damping[j] = gains_[j].damping;
    }
    command.effort = added_.update(in).effort;
    return command;
  }

  /// Goes on with other springs and dampers. Real-time: yes.
  void set_gains(const ValidImpedanceGains<joint_count>& gains) noexcept { gains_ = gains; }

  [[nodiscard]] const JointImpedanceGains<joint_count>& gains() const noexcept {
    return gains_.values();
  }

 private:
  ValidImpedanceGains<joint_count> gains_;
  SumController<R, EffortCommand<joint_count, S>, GravityCompensation<R, S>,
                EffortFeedforward<joint_count, S>>
      added_;
};

}  // namespace articula
