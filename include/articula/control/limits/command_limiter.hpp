// SPDX-License-Identifier: Apache-2.0
/// @file Limits for each kind of command, as Limited applies them.
#pragma once

#include "articula/command/drive_spring.hpp"
#include "articula/control/limits/effort_limiter.hpp"
#include "articula/control/limits/limit_motion.hpp"
#include "articula/control/limits/limit_position.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/joint_command.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

namespace articula::detail {

/// The limits of one kind of command. The numbers are those of numbers_of.
///
/// - `start(in)` begins at the measured state.
/// - `limit(in, command, report)` keeps a command within the limits. It returns the numbers of the
///   result, N x 1.
/// - `brake(in, command, report)` replaces the command by one that brakes all joints.
template <Robot R, class Command>
class CommandLimiter;

/// The request at which the steps of single joints and of efforts brake.
inline constexpr double no_request = std::numeric_limits<double>::quiet_NaN();

/// For positions and velocities, each joint by itself.
template <Robot R, class Command>
  requires(!requires(Command command) { command.effort; })
class CommandLimiter<R, Command> {
  static constexpr int N = joint_count<R>;
  static constexpr bool of_positions = std::same_as<Command, PositionCommand<N>>;
  using Vector = JointVector<N>;
  using State = std::conditional_t<of_positions, PositionLimitState, StoppingMotion>;

 public:
  CommandLimiter(const R&, const CommandLimits<N>& kept) : limits(kept) {}

  void start(const ControlInput<N>& in) noexcept {
    for (int j = 0; j < N; ++j) {
      states_[j] = {stop_from({in.state.position[j], in.state.velocity[j], 0}, limits.of_joint(j),
                              in.period)};
    }
  }
  Vector limit(const ControlInput<N>& in, Command& command, LimitReport<N>& report) noexcept {
    Vector numbers = values_of(command);
    for (int j = 0; j < N; ++j) {
      const JointCommandLimits own = limits.of_joint(j);
      if constexpr (of_positions) {
        const PositionStep step = limit_position(states_[j], numbers[j], own, in.period);
        take(step, step.next.stop.motion().position, j, numbers, report);
      } else {
        const MotionStep step =
            limit_velocity(states_[j], in.state.position[j], numbers[j], own, in.period);
        take(step, step.next.motion().velocity, j, numbers, report);
      }
    }
    command = {numbers};
    return numbers;
  }
  Vector brake(const ControlInput<N>& in, Command& command, LimitReport<N>& report) noexcept {
    command = {Vector::Constant(no_request)};
    return limit(in, command, report);
  }

  CommandLimits<N> limits;

 private:
  void take(const auto& step, double number, int joint, Vector& numbers,
            LimitReport<N>& report) noexcept {
    states_[joint] = step.next;
    report[joint] = step.report;
    numbers[joint] = number;
  }

  JointArray<State, N> states_{};
};

/// For commands that contain efforts.
template <Robot R>
class LimiterOfEfforts {
 protected:
  static constexpr int N = joint_count<R>;
  using Vector = JointVector<N>;

 public:
  LimiterOfEfforts(const R& robot, const CommandLimits<N>& kept)
      : limits(kept), limiter_(robot, kept) {}

  void start(const ControlInput<N>& in) noexcept {
    // Drives that measure no effort would have limits of `effort_rate` begin at 0.
    state_ = {.effort = in.applied.held == Held::nothing ? in.state.effort : in.applied.numbers};
  }

  CommandLimits<N> limits;

 protected:
  /// The efforts within the limits, after the last ones less their cut, N x 1.
  [[nodiscard]] Vector limited(const ControlInput<N>& in, const Vector& asked,
                               LimitReport<N>& report, const Vector& stiffness = Vector::Zero(),
                               const Vector& damping = Vector::Zero()) noexcept {
    state_.effort -= in.cut;
    const EffortStep<N> step =
        limiter_.limit(state_, in.state, asked, in.period, stiffness, damping);
    state_ = step.next;
    report = step.report;
    return step.next.effort;
  }

 private:
  EffortLimiter<R> limiter_;
  EffortLimitState<N> state_{};
};

template <Robot R>
class CommandLimiter<R, EffortCommand<joint_count<R>>> : public LimiterOfEfforts<R> {
  using typename LimiterOfEfforts<R>::Vector;
  using LimiterOfEfforts<R>::N;

 public:
  using LimiterOfEfforts<R>::LimiterOfEfforts;

  Vector limit(const ControlInput<N>& in, EffortCommand<N>& command,
               LimitReport<N>& report) noexcept {
    return command.effort = this->limited(in, command.effort, report);
  }
  Vector brake(const ControlInput<N>& in, EffortCommand<N>& command,
               LimitReport<N>& report) noexcept {
    return command.effort = this->limited(in, Vector::Constant(no_request), report);
  }
};

/// The total effort keeps the limits. Where it is too much, the drive's references are drawn
/// towards the state.
template <Robot R>
class CommandLimiter<R, MultiModeCommand<joint_count<R>>> : public LimiterOfEfforts<R> {
  using typename LimiterOfEfforts<R>::Vector;
  using LimiterOfEfforts<R>::N;

 public:
  using LimiterOfEfforts<R>::LimiterOfEfforts;

  Vector limit(const ControlInput<N>& in, MultiModeCommand<N>& command,
               LimitReport<N>& report) noexcept {
    const CommandLimits<N>& kept = this->limits;
    const MultiModeCommand<N> asked = command;
    command.position = asked.position.cwiseMax(kept.lower).cwiseMin(kept.upper);
    command.velocity = asked.velocity.cwiseMax(-kept.velocity).cwiseMin(kept.velocity);
    command.stiffness = asked.stiffness.cwiseMax(0);
    command.damping = asked.damping.cwiseMax(0);
    const Vector total = spring_pull(command, in.state) + asked.effort;
    const Vector effort = this->limited(in, total, report, command.stiffness, command.damping);
    for (int j = 0; j < N; ++j) {
      report[j].position = report[j].position || command.position[j] != asked.position[j];
      report[j].velocity = report[j].velocity || command.velocity[j] != asked.velocity[j];
      report[j].stiffness = command.stiffness[j] != asked.stiffness[j];
      report[j].damping = command.damping[j] != asked.damping[j];
      if (effort[j] == total[j] && std::abs(asked.effort[j]) <= kept.effort[j]) continue;
      set_total(command, in.state, j, effort[j], kept.effort[j]);
    }
    return effort;
  }
  /// By the effort alone, without springs.
  Vector brake(const ControlInput<N>& in, MultiModeCommand<N>& command,
               LimitReport<N>& report) noexcept {
    command = {};
    return command.effort = this->limited(in, Vector::Constant(no_request), report);
  }
};

}  // namespace articula::detail
