// SPDX-License-Identifier: Apache-2.0
/// @file What the joints are commanded while no controller is active.
#pragma once

#include "articula/control/safety/damping_effort.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <concepts>
#include <string_view>

namespace articula {

/// The controller that wants nothing but safety, whatever the reference says:
///
///     efforts      g(q) - M(q) v / T: the weight is carried, motion decays (see damping_effort)
///     velocities   zero
///     positions    that at which it was started
///     multi-mode   no spring, no damper, the effort as above
///
/// A Switch does this while no controller is active. It can be one of its controllers, too.
/// @tparam R  the robot
/// @tparam C  the command
template <Robot R, JointCommand<joint_count<R>> C = EffortCommand<joint_count<R>>>
class Standby {
 public:
  static constexpr std::string_view name = "standby";
  /// It uses no reference.
  static constexpr bool brakes_without_reference = true;
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

  /// Takes the position that is to be held. Real-time: yes.
  void start(const JointState<joint_count>& state) noexcept { position_ = state.position; }

  /// The safe command for the coming period. Without a good state efforts are zero. Real-time: yes.
  [[nodiscard]] C update(const JointState<joint_count>& state, const JointReference<joint_count>&,
                         double period) noexcept {
    C command;
    if constexpr (requires { command.effort; }) {
      const double time = is_finite(period) ? std::max(damping_time_, 2 * period) : damping_time_;
      command.effort = damping_effort(robot_, state.position, state.velocity, time);
      if (!is_finite(command.effort)) command.effort.setZero();
      return limited(robot_, command);
    } else {
      if constexpr (std::same_as<C, PositionCommand<joint_count>>) command.position = position_;
      return command;
    }
  }

 private:
  [[no_unique_address]] R robot_;
  double damping_time_;
  JointVector<joint_count> position_ = JointVector<joint_count>::Zero();  ///< [rad or m]
};

}  // namespace articula
