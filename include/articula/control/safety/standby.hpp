// SPDX-License-Identifier: Apache-2.0
/// @file The controller for times without an active one.
#pragma once

#include "articula/control/safety/damping_effort.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <concepts>
#include <string_view>

namespace articula {

/// The controller that keeps the joints safe, whatever the reference says:
///
///     efforts      g(q) - M(q) v / T: the weight is carried, motion decays (see damping_effort)
///     velocities   zero
///     positions    the one commanded before it was started
///     multi-mode   no spring, no damper, the effort as above
///
/// A Switch does this while no controller is active. It can be one of its controllers, too.
/// @tparam R  the robot
/// @tparam C  the command
template <Robot R, JointCommand<joint_count<R>> C = EffortCommand<joint_count<R>>>
class Standby {
 public:
  static constexpr std::string_view name = "standby";
  static constexpr int joint_count = articula::joint_count<R>;

  Standby()
    requires DescribedRobot<R>
      : Standby(0.1) {}
  /// @param robot         whose weight is carried
  /// @param damping_time  T, in which the velocity falls to 1/e [s]; shorter than two periods it is
  ///                      taken for those
  /// @throws std::invalid_argument if T is not a number > 0
  Standby(const R& robot, double damping_time) : robot_(robot), damping_time_(damping_time) {
    if (is_finite(damping_time) && damping_time > 0) return;
    detail::refuse({"standby: damping_time ", damping_time, " s is not a number > 0"});
  }
  /// For a robot known at compile time.
  explicit Standby(double damping_time)
    requires DescribedRobot<R>
      : Standby(R(), damping_time) {}

  /// Takes the position to hold: the one that was commanded last, or else the measured one, which
  /// would creep. Real-time: yes.
  void start(const ControlInput<joint_count>& in) noexcept {
    position_ = in.applied.reached_drives() ? in.applied.numbers : in.state.position;
  }

  /// The safe command for the coming period. Real-time: yes.
  [[nodiscard]] C update(const ControlInput<joint_count>& in) noexcept {
    C command;
    if constexpr (requires { command.effort; }) {
      const double time = std::max(damping_time_, 2 * in.period);
      command.effort = damping_effort(robot_, in.state.position, in.state.velocity, time);
      if (!is_finite(command.effort)) command.effort.setZero();
      return within_effort_limits(robot_, command);
    } else {
      if constexpr (std::same_as<C, PositionCommand<joint_count>>) command.position = position_;
      return command;
    }
  }

  /// Does the same: it uses no reference. Real-time: yes.
  [[nodiscard]] C brake(const ControlInput<joint_count>& in) noexcept { return update(in); }

 private:
  [[no_unique_address]] R robot_;
  double damping_time_;
  JointVector<joint_count> position_ = JointVector<joint_count>::Zero();  ///< [rad or m]
};

}  // namespace articula
