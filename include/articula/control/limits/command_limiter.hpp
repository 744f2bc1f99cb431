// SPDX-License-Identifier: Apache-2.0
/// @file Limits for each kind of command, as Limited applies them.
#pragma once

#include "articula/control/laws/drive_spring.hpp"
#include "articula/control/limits/effort_limiter.hpp"
#include "articula/control/limits/joint_limiter.hpp"
#include "articula/control/limits/position_limiter.hpp"
#include "articula/core/control_input.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/joint_command.hpp"

#include <cmath>
#include <limits>

namespace articula::detail {

/// What Limited needs for one kind of command. Its numbers are those of numbers_of.
///
/// - `start(in)` begins at the measured state. It returns the numbers that the first command goes on
///   from, N x 1.
/// - `limit(in, last, command, report)` keeps a command within the limits, after one with the
///   numbers `last`. It returns the numbers of the result, N x 1.
/// - `brake(in, last, command, report)` replaces the command by one that brakes all joints.
template <Robot R, class Command>
class CommandLimiter;

/// The limiters of all joints, for commands that say where the joints go.
template <class OfJoint, int N>
class LimitersOfJoints {
 public:
  explicit LimitersOfJoints(const CommandLimits<N>& limits) {
    for (int j = 0; j < N; ++j) limiters_[j] = OfJoint(limits, j);
  }

 protected:
  void start_all(const ControlInput<N>& in) noexcept {
    period_ = in.period;
    for (int j = 0; j < N; ++j) {
      limiters_[j].start({in.state.position[j], in.state.velocity[j], 0}, period_);
    }
  }

  /// The limiters, for cycles of this length [s].
  [[nodiscard]] JointArray<OfJoint, N>& limiters(double period) noexcept {
    if (period != period_) {
      for (OfJoint& limiter : limiters_) limiter.set_period(period);
    }
    period_ = period;
    return limiters_;
  }

 private:
  JointArray<OfJoint, N> limiters_{};
  double period_ = 1e-3;  ///< [s]
};

template <Robot R>
class CommandLimiter<R, PositionCommand<joint_count<R>>>
    : LimitersOfJoints<PositionLimiter, joint_count<R>> {
  static constexpr int N = joint_count<R>;
  using Vector = JointVector<N>;

 public:
  CommandLimiter(const R&, const CommandLimits<N>& limits)
      : CommandLimiter::LimitersOfJoints(limits) {}

  Vector start(const ControlInput<N>& in) noexcept {
    this->start_all(in);
    return in.state.position;
  }
  Vector limit(const ControlInput<N>& in, const Vector&, PositionCommand<N>& command,
               LimitReport<N>& report) noexcept {
    auto& limiters = this->limiters(in.period);
    for (int j = 0; j < N; ++j) {
      command.position[j] = limiters[j].limit(command.position[j], report[j]);
    }
    return command.position;
  }
  Vector brake(const ControlInput<N>& in, const Vector&, PositionCommand<N>& command,
               LimitReport<N>& report) noexcept {
    auto& limiters = this->limiters(in.period);
    for (int j = 0; j < N; ++j) command.position[j] = limiters[j].brake(report[j]);
    return command.position;
  }
};

template <Robot R>
class CommandLimiter<R, VelocityCommand<joint_count<R>>>
    : LimitersOfJoints<JointLimiter, joint_count<R>> {
  static constexpr int N = joint_count<R>;
  using Vector = JointVector<N>;

 public:
  CommandLimiter(const R&, const CommandLimits<N>& limits)
      : CommandLimiter::LimitersOfJoints(limits) {}

  Vector start(const ControlInput<N>& in) noexcept {
    this->start_all(in);
    return in.state.velocity;
  }
  Vector limit(const ControlInput<N>& in, const Vector&, VelocityCommand<N>& command,
               LimitReport<N>& report) noexcept {
    auto& limiters = this->limiters(in.period);
    for (int j = 0; j < N; ++j) {
      limiters[j].measured(in.state.position[j]);
      static_cast<void>(limiters[j].move(command.velocity[j], report[j]));
      command.velocity[j] = limiters[j].motion().velocity;
    }
    return command.velocity;
  }
  Vector brake(const ControlInput<N>& in, const Vector& last, VelocityCommand<N>& command,
               LimitReport<N>& report) noexcept {
    command.velocity.setConstant(std::numeric_limits<double>::quiet_NaN());  // JointLimiter brakes
    return limit(in, last, command, report);
  }
};

/// The limiter of efforts, for commands that contain some.
template <Robot R>
class LimiterOfEfforts {
  static constexpr int N = joint_count<R>;

 public:
  LimiterOfEfforts(const R& robot, const CommandLimits<N>& limits) : limiter_(robot, limits) {}

  JointVector<N> start(const ControlInput<N>& in) noexcept {
    period_ = in.period;
    limiter_.start(in.state, period_);
    // Drives that measure no effort would have limits of `effort_rate` begin at 0.
    return in.applied.held == Held::nothing ? in.state.effort : in.applied.numbers;
  }

 protected:
  /// The limiter, for a cycle of this length [s] after one with the efforts `last`, N x 1.
  [[nodiscard]] EffortLimiter<R>& limiter(double period, const JointVector<N>& last) noexcept {
    if (period != period_) limiter_.set_period(period);
    period_ = period;
    limiter_.given(last);
    return limiter_;
  }
  [[nodiscard]] JointVector<N> braking_effort(const ControlInput<N>& in, const JointVector<N>& last,
                                              LimitReport<N>& report) noexcept {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();  // EffortLimiter brakes
    return limiter(in.period, last).limit(in.state, JointVector<N>::Constant(none), report);
  }

 private:
  EffortLimiter<R> limiter_;
  double period_ = 1e-3;  ///< [s]
};

template <Robot R>
class CommandLimiter<R, EffortCommand<joint_count<R>>> : public LimiterOfEfforts<R> {
  static constexpr int N = joint_count<R>;
  using Vector = JointVector<N>;

 public:
  using LimiterOfEfforts<R>::LimiterOfEfforts;

  Vector limit(const ControlInput<N>& in, const Vector& last, EffortCommand<N>& command,
               LimitReport<N>& report) noexcept {
    return command.effort = this->limiter(in.period, last).limit(in.state, command.effort, report);
  }
  Vector brake(const ControlInput<N>& in, const Vector& last, EffortCommand<N>& command,
               LimitReport<N>& report) noexcept {
    return command.effort = this->braking_effort(in, last, report);
  }
};

/// The total effort keeps the limits. Where it is too much, the drive's references are drawn towards
/// the state.
template <Robot R>
class CommandLimiter<R, MultiModeCommand<joint_count<R>>> : public LimiterOfEfforts<R> {
  static constexpr int N = joint_count<R>;
  using Vector = JointVector<N>;

 public:
  CommandLimiter(const R& robot, const CommandLimits<N>& limits)
      : LimiterOfEfforts<R>(robot, limits), limits_(limits) {}

  Vector limit(const ControlInput<N>& in, const Vector& last, MultiModeCommand<N>& command,
               LimitReport<N>& report) noexcept {
    const MultiModeCommand<N> asked = command;
    command.position = asked.position.cwiseMax(limits_.lower).cwiseMin(limits_.upper);
    command.velocity = asked.velocity.cwiseMax(-limits_.velocity).cwiseMin(limits_.velocity);
    command.stiffness = asked.stiffness.cwiseMax(0);
    command.damping = asked.damping.cwiseMax(0);
    const Vector total = spring_pull(command, in.state) + asked.effort;
    const Vector effort = this->limiter(in.period, last)
                              .limit(in.state, total, report, command.stiffness, command.damping);
    for (int j = 0; j < N; ++j) {
      JointLimitReport& of_joint = report[j];
      of_joint.position = of_joint.position || command.position[j] != asked.position[j];
      of_joint.velocity = of_joint.velocity || command.velocity[j] != asked.velocity[j];
      of_joint.stiffness = command.stiffness[j] != asked.stiffness[j];
      of_joint.damping = command.damping[j] != asked.damping[j];
      if (effort[j] == total[j] && std::abs(asked.effort[j]) <= limits_.effort[j]) continue;
      set_total(command, in.state, j, effort[j], limits_.effort[j]);
    }
    return effort;
  }
  /// By the effort alone, without springs.
  Vector brake(const ControlInput<N>& in, const Vector& last, MultiModeCommand<N>& command,
               LimitReport<N>& report) noexcept {
    command = {};
    return command.effort = this->braking_effort(in, last, report);
  }

 private:
  CommandLimits<N> limits_;
};

}  // namespace articula::detail
