// SPDX-License-Identifier: Apache-2.0
/// @file The controller that brakes while no other one is active.
#pragma once

#include "articula/control/safety/damping_effort.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/refuse.hpp"
#include "articula/core/scalar.hpp"

#include <algorithm>
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
/// @tparam C  the command, over double or a pack with the numbers of several robots
template <Robot R, class C = EffortCommand<joint_count<R>>>
  requires JointCommand<C, joint_count<R>, typename detail::CommandScalar<C>::Type>
class Standby {
 public:
  static constexpr std::string_view name = "standby";
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr bool follows_position = false;
  using Scalar = typename detail::CommandScalar<C>::Type;
  using Input = ControlInput<joint_count, Scalar>;

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
  void start(const Input& in) noexcept {
    position_ = in.applied.reached_drives() ? in.applied.numbers : in.state.position;
  }

  /// The safe command for the coming period. Real-time: yes.
  [[nodiscard]] C update(const Input& in) noexcept {
    C command;
    if constexpr (requires { command.effort; }) {
      const double time = std::max(damping_time_, 2 * in.period);
      command.effort = damping_effort(robot_, in.state.position, in.state.velocity, time);
      const MaskOf<Scalar> overflows = not_of(is_finite(command.effort));
      for (int j = 0; j < joint_count; ++j) replace_where(overflows, command.effort[j], 0);
      return within_effort_limits(robot_, command);
    } else {
      if constexpr (requires { command.position; }) command.position = position_;
      return command;
    }
  }

  /// Does the same: it uses no reference. Real-time: yes.
  [[nodiscard]] C brake(const Input& in) noexcept { return update(in); }

 private:
  [[no_unique_address]] R robot_;
  double damping_time_;
  JointVector<joint_count, Scalar> position_ =
      JointVector<joint_count, Scalar>::Zero();  ///< [rad or m]
};

}  // namespace articula
