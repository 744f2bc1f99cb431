// SPDX-License-Identifier: Apache-2.0
/// @file Bumpless transfer between the commands of two controllers.
#pragma once

#include "articula/command/command_numbers.hpp"
#include "articula/command/command_range.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/refuse.hpp"
#include "articula/core/scalar.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

namespace articula {

/// Lets the commands of one controller go on where those of another left off. With u_k the
/// controller's own command of cycle k, y_k the command after the transfer, dt the period and r the
/// slew:
///
///     when it takes over   y_k = y_k-1,             c_k = y_k - u_k
///     from then on         y_k = clamp(u_k + c_k),  c_k = c_k-1 moved towards 0 by at most r dt
///
/// So whatever controllers follow each other, and however fast, each joint's command changes by
///
///     |y_k - y_k-1| <= |u_k - u_k-1| + r dt,   and where another takes over by 0.
///
/// All within what the robot's description allows. A clamp takes from c alone, never from u; a
/// command without a difference to carry passes unchanged.
///
/// The number that counts is the effort, velocity or position. For a MultiModeCommand it is the
/// whole effort that it makes at the measured state. The difference is added to its effort. Beyond
/// the drives' limit, the drive's references are drawn towards the state as far as needed.
/// @tparam R  the robot
/// @tparam C  the command, over double or a pack with the numbers of several robots
template <Robot R, class C>
  requires JointCommand<C, joint_count<R>, typename detail::CommandScalar<C>::Type>
class BumplessTransfer {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Scalar = typename detail::CommandScalar<C>::Type;
  using Vector = JointVector<joint_count, Scalar>;
  using Slew = JointVector<joint_count>;
  using State = JointState<joint_count, Scalar>;

  /// @param robot  within whose limits commands are kept
  /// @param slew   r, how fast differences decay [unit of the command per s], N x 1
  /// @throws std::invalid_argument naming the joint whose slew is not a number > 0
  BumplessTransfer(const R& robot, const Slew& slew)
      : slew_(slew), range_(detail::command_range<C>(robot, huge)) {
    for (int j = 0; j < joint_count; ++j) {
      if (is_finite(slew[j]) && slew[j] > 0) continue;
      detail::refuse({"switch: slew ", slew[j], " of joint '",
                      joint_names(robot)[static_cast<std::size_t>(j)], "' is not a number > 0"});
    }
  }

  /// The default slew: from 0 to the drive's limit within 0.1 s, for efforts and velocities; a
  /// quarter of the velocity limit for positions. It is infinite for a joint without such a limit,
  /// whose slew must be given.
  /// Real-time: yes.
  [[nodiscard]] static Slew default_slew(const R& robot) noexcept {
    if constexpr (std::same_as<C, PositionCommand<joint_count, Scalar>>) {
      return joint_values(robot, [](const JointProperties& j) { return j.limits.velocity / 4; });
    } else {
      const auto range = detail::command_range<C>(robot);
      return for_each_joint<joint_count>(
          [&](int j) { return range.highest[j] > 0 ? range.highest[j] / 0.1 : 1; });
    }
  }

  /// Forgets all differences: the next command passes as it is. Real-time: yes.
  void start() noexcept {
    carried_.setZero();
    takes_over_ = false;
  }

  /// Lets the next command go on from the last one. Real-time: yes.
  void take_over() noexcept { takes_over_ = true; }

  /// Sets what was applied in the end in place of the last command, finite, N x 1. Real-time: yes.
  void set_applied(const Vector& numbers) noexcept { applied_ = bounded(numbers); }

  /// Whether a command can be passed on: whether its numbers are finite, those of all robots.
  /// Real-time: yes.
  [[nodiscard]] static bool passable(const C& command, const State& state) noexcept {
    return all_of(is_finite(command)) && all_of(is_finite(numbers_of(command, state)));
  }

  /// The command after the transfer.
  /// @param command  the controller's own, passable
  /// @param state    measured joints
  /// @param period   dt [s]
  /// Real-time: yes.
  [[nodiscard]] C pass(const C& command, const State& state, double period) noexcept {
    const Vector own = bounded(numbers_of(command, state));
    if (takes_over_) {
      carried_ = applied_ - own;
    } else {
      for (int j = 0; j < joint_count; ++j) {
        const double step = slew_[j] * period;
        carried_[j] -= clamp(carried_[j], -step, step);
      }
    }
    takes_over_ = false;
    applied_ = bounded(own + carried_);
    carried_ = applied_ - own;
    return with_total(command, own, state);
  }

  /// The numbers that the next command goes on from, N x 1. Real-time: yes.
  [[nodiscard]] const Vector& applied() const noexcept { return applied_; }
  /// c, what is still carried, N x 1. Real-time: yes.
  [[nodiscard]] const Vector& carried() const noexcept { return carried_; }
  /// r, N x 1. Real-time: yes.
  [[nodiscard]] const Slew& slew() const noexcept { return slew_; }
  /// The controller's own command that is cut off by the robot's limits, N x 1. Real-time: yes.
  [[nodiscard]] Vector excess(const C& command, const State& state) const noexcept {
    const Vector own = numbers_of(command, state);
    return own - bounded(own);
  }

 private:
  static constexpr double huge = 1e300;  ///< in place of infinite limits: no sum overflows

  [[nodiscard]] Vector bounded(const Vector& values) const noexcept {
    return for_each_joint<joint_count, Scalar>([&](int j) { return range_.clamp(values[j], j); });
  }

  /// The command with the transferred numbers in place of its own.
  [[nodiscard]] C with_total(C command, const Vector& own, const State& state) const noexcept {
    if constexpr (requires { command.stiffness; }) {
      for (int k = 0; k < lanes<Scalar>; ++k) {
        auto of_lane = lane_of(command, k);
        const JointState<joint_count> measured = lane_of(state, k);
        for (int j = 0; j < joint_count; ++j) {
          const double total = lane_of(applied_[j], k);
          if (total == lane_of(own[j], k)) continue;
          of_lane.effort[j] += total - numbers_of(of_lane, measured)[j];
          limit_total(of_lane, measured, j, range_.highest[j]);
        }
        set_lane(command, k, of_lane);
      }
      return command;
    } else {
      return {applied_};
    }
  }

  Slew slew_;
  detail::CommandRange<joint_count> range_;
  Vector applied_ = Vector::Zero();  ///< y
  Vector carried_ = Vector::Zero();  ///< c
  bool takes_over_ = false;
};

}  // namespace articula
