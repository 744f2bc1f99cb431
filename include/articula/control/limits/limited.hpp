// SPDX-License-Identifier: Apache-2.0
/// @file A controller whose commands keep limits.
#pragma once

#include "articula/control/laws/command_numbers.hpp"
#include "articula/control/laws/drive_spring.hpp"
#include "articula/control/laws/effort_law.hpp"
#include "articula/control/limits/effort_limiter.hpp"
#include "articula/control/limits/limit_position.hpp"
#include "articula/control/safety/resume.hpp"
#include "articula/control/safety/tells_failure.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/joint_reference.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <exception>
#include <limits>
#include <type_traits>
#include <utility>

namespace articula {

/// A controller whose commands keep limits of position, velocity, acceleration, jerk and effort, so
/// that every joint can always stop before its position limit (see limit_motion):
///
///     template <class R>
///     using CarefulPid = articula::Limited<R, articula::PidPlusGravity>;
///     articula::Loop<articula::Q2dSim, CarefulPid> loop{CarefulPid<articula::Q2d>(limits)};
///
/// - Position commands: limits hold for the commands, which begin where the joint is measured.
/// - Velocity commands: likewise, at the measured position; a drive that lags needs some room.
/// - Effort commands: limits hold for the motion that the model foresees (see EffortLimiter).
/// - Multi-mode commands: likewise, for the total effort at the measured state. Where it is too
///   much, the drive's references are drawn towards the state.
///
/// What is within the limits passes unchanged. A command that is not finite, or does not count
/// because the controller says that it has failed (TellsFailure), brakes all joints, and `failed`
/// tells. (Groups brake the joints of a failed group themselves.) A reference that is not finite
/// brakes all joints, too: the controller is not asked in that cycle. After more than three such
/// cycles in a row it is started anew, and goes on from what was given. The controller is told what
/// was cut off, and what was given, if it wants to know (LimitAware, TakesGiven).
/// @tparam R                   the robot
/// @tparam ControllerTemplate  makes the controller of a robot
template <Robot R, template <class> class ControllerTemplate>
class Limited {
 public:
  /// The command counts even where `failed` tells: the joints brake.
  static constexpr bool safe_in_failure = true;
  /// A reference that is not finite brakes the joints, too.
  static constexpr bool brakes_without_reference = true;
  static constexpr int joint_count = articula::joint_count<R>;
  using ControllerType = ControllerTemplate<R>;
  using State = JointState<joint_count>;
  using Reference = JointReference<joint_count>;
  using Command = decltype(std::declval<ControllerType&>().update(
      std::declval<const State&>(), std::declval<const Reference&>(), double()));

  /// Whether the command contains efforts.
  static constexpr bool by_effort = requires(Command command) { command.effort; };

  /// The limits of the robot's description. (For efforts it does not say enough.)
  Limited()
    requires DescribedRobot<R> && std::default_initializable<ControllerType> && (!by_effort)
      : Limited(command_limits(R())) {}

  /// @param robot       whose joints these are
  /// @param limits      to keep
  /// @param controller  whose commands are limited
  /// @throws std::invalid_argument naming joint, limit and value if a limit makes no sense, is
  ///         beyond what the description says, or is missing (see EffortLimiter)
  Limited(const R& robot, const CommandLimits<joint_count>& limits, ControllerType controller)
      : controller_(std::move(controller)),
        limits_(limits),
        limiter_(make_limiter(robot, limits)) {}
  /// With a controller that is made from the robot, or by default where none can be.
  Limited(const R& robot, const CommandLimits<joint_count>& limits)
      : Limited(robot, limits, controller_of(robot)) {}
  /// For a robot known at compile time.
  Limited(const CommandLimits<joint_count>& limits, ControllerType controller)
    requires DescribedRobot<R>
      : Limited(R(), limits, std::move(controller)) {}
  /// @copydoc Limited(const CommandLimits<joint_count>&, ControllerType)
  explicit Limited(const CommandLimits<joint_count>& limits)
    requires DescribedRobot<R>
      : Limited(R(), limits) {}

  /// Starts the controller anew; the limits begin at the measured state. Real-time: yes.
  void start(const State& state) noexcept {
    controller_.start(state);
    started_ = failed_ = goes_on_ = false;
    unasked_cycles_ = 0;
  }

  /// The controller's command, limited. Before any position is known a position command is NaN,
  /// which no loop writes.
  /// Real-time: yes, if the controller's is.
  [[nodiscard]] Command update(const State& state, const Reference& reference,
                               double period) noexcept {
    const Command asked = ask(state, reference, period);
    report_ = {};
    begin_cycle(state, period);
    if constexpr (std::same_as<Command, EffortCommand<joint_count>>) {
      return {told(asked.effort, limit_effort(state, asked.effort))};
    } else if constexpr (std::same_as<Command, VelocityCommand<joint_count>>) {
      return {told(asked.velocity, limit_velocity(state, asked.velocity))};
    } else if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      return {told(asked.position, limit_position(asked.position))};
    } else {
      return limit_multi_mode(state, asked);
    }
  }

  /// Lets limits of `effort_rate` go on from what was given last, and the controller begin with it,
  /// if it can. Real-time: yes.
  /// @return  what the controller begins with of it, N x 1
  JointVector<joint_count> prime(const State& state, const Reference& reference, double period,
                                 const JointVector<joint_count>& command,
                                 LastCommand is = LastCommand::any) noexcept {
    go_on_from(command);
    if constexpr (Primable<ControllerType, joint_count>) {
      return detail::prime(controller_, state, reference, period, command, is);
    } else {
      return Vector::Zero();
    }
  }

  /// Hears what was given in the end, or by others since the start: N x 1, see numbers_of. Limits
  /// of `effort_rate` go on from there. (Drives that measure no effort would have them begin at 0.)
  /// Real-time: yes.
  void given(const JointVector<joint_count>& command) noexcept {
    go_on_from(command);
    if constexpr (TakesGiven<ControllerType, joint_count>) controller_.given(command);
  }

  /// Whether the controller gave no command in the last update, although state and reference were
  /// good, or said that it has failed. Real-time: yes.
  [[nodiscard]] bool failed() const noexcept { return failed_; }

  /// What the last update changed. Real-time: yes.
  [[nodiscard]] const LimitReport<joint_count>& report() const noexcept { return report_; }
  [[nodiscard]] const CommandLimits<joint_count>& limits() const noexcept { return limits_; }
  [[nodiscard]] ControllerType& controller() noexcept { return controller_; }
  [[nodiscard]] const ControllerType& controller() const noexcept { return controller_; }

  /// Calls function(controller).
  void for_each_part(auto&& function) const { function(controller_); }

  /// Goes on with other gains of the controller. Real-time: yes.
  template <class Gains>
    requires TakesGains<ControllerType, Gains>
  void set_gains(const Gains& gains) noexcept {
    controller_.set_gains(gains);
  }

 private:
  using Vector = JointVector<joint_count>;
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  static constexpr bool by_position = std::same_as<Command, PositionCommand<joint_count>>;
  using OfJoint = std::conditional_t<by_position, PositionLimitState, StoppingMotion>;
  using LimitState = std::conditional_t<by_effort, EffortLimitState<joint_count>,
                                        JointArray<OfJoint, joint_count>>;
  struct NoModel {};
  using Limiter = std::conditional_t<by_effort, EffortLimiter<R>, NoModel>;

  [[nodiscard]] static ControllerType controller_of(const R& robot) {
    if constexpr (std::constructible_from<ControllerType, const R&>) {
      return ControllerType(robot);
    } else if constexpr (std::default_initializable<ControllerType>) {
      return ControllerType();
    } else {
      static_assert(std::default_initializable<ControllerType>,
                    "Limited cannot make this controller from the robot alone: pass the "
                    "controller behind the limits");
      std::terminate();
    }
  }

  [[nodiscard]] static Limiter make_limiter(const R& robot,
                                            const CommandLimits<joint_count>& limits) {
    validate(robot, limits);
    if constexpr (by_effort) {
      return EffortLimiter<R>(robot, limits);
    } else {
      return {};
    }
  }

  /// The controller's command; one that is not finite where none counts.
  [[nodiscard]] Command ask(const State& state, const Reference& reference,
                            double period) noexcept {
    if (!is_finite(reference)) {
      if (unasked_cycles_ <= detail::borne_cycles) ++unasked_cycles_;
      failed_ = false;
      return no_command<Command>();
    }
    if (unasked_cycles_ > detail::borne_cycles && is_finite(state)) {
      Vector last;
      for (int j = 0; j < joint_count; ++j) last[j] = report_[j].given;
      detail::resume(controller_, state, reference, period, last);
    }
    unasked_cycles_ = 0;
    const Command asked = controller_.update(state, reference, period);
    const bool none = !is_finite(asked) || !is_finite(numbers_of(asked, state));
    failed_ = (none || has_failed(controller_)) && is_finite(state);
    return command_counts(controller_) ? asked : no_command<Command>();
  }

  /// Before the first cycle the joints' motion is what is measured; with another period they go on.
  void begin_cycle(const State& state, double period) noexcept {
    const bool usable = period > 0 && period < 1e6;  // s; beyond, motions overflow
    const bool begins = !started_ && is_finite(state);
    if (usable) period_ = period;
    if constexpr (by_effort) {
      if (begins) limit_state_ = {.effort = goes_on_ ? last_given_ : state.effort};
    } else if (begins) {
      for (int j = 0; j < joint_count; ++j) {
        const JointCommandLimits limits = limits_.of_joint(j);
        limit_state_[j] = {StoppingMotion({state.position[j], state.velocity[j], 0},
                                          limits.deceleration, limits.jerk, period_)};
      }
    }
    started_ = started_ || begins;
  }

  void go_on_from(const Vector& command) noexcept {
    if constexpr (by_effort) {
      goes_on_ = is_finite(command);
      last_given_ = command;
      if (started_ && goes_on_) limit_state_.effort = command;
    }
  }

  /// Notes what became of a command, and tells the controller.
  [[nodiscard]] const Vector& told(const Vector& asked, const Vector& given) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      JointLimitReport& report = report_[j];
      // What only rounding has changed is not worth a report. What is no number always is, and so
      // is a stiffness or damping that has changed, though it may pull nothing at this state.
      if (std::abs(asked[j] - given[j]) <= 1e-12 * (1 + std::abs(given[j]))) {
        report = {.stiffness = report.stiffness,
                  .damping = report.damping,
                  .non_finite = report.non_finite};
      }
      report.asked = asked[j];
      report.given = given[j];
    }
    if constexpr (LimitAware<ControllerType, joint_count>) {
      if (unasked_cycles_ == 0) controller_.limited(asked - given);
    }
    if constexpr (TakesGiven<ControllerType, joint_count>) controller_.given(given);
    return given;
  }

  [[nodiscard]] Vector limit_position(const Vector& asked) noexcept {
    if (!started_) return Vector::Constant(not_a_number);
    const bool brake = !is_finite(asked);
    Vector given;
    for (int j = 0; j < joint_count; ++j) {
      const PositionStep step = articula::limit_position(
          limit_state_[j], brake ? not_a_number : asked[j], limits_.of_joint(j), period_);
      limit_state_[j] = step.next;
      report_[j] = step.report;
      given[j] = step.next.stop.motion().position;
    }
    return given;
  }

  [[nodiscard]] Vector limit_velocity(const State& state, const Vector& asked) noexcept {
    if (!started_) return Vector::Zero();
    const bool brake = !is_finite(asked) || !is_finite(state.position);
    Vector given;
    for (int j = 0; j < joint_count; ++j) {
      const MotionStep step =
          articula::limit_velocity(limit_state_[j], state.position[j],
                                   brake ? not_a_number : asked[j], limits_.of_joint(j), period_);
      limit_state_[j] = step.next;
      report_[j] = step.report;
      given[j] = step.next.motion().velocity;
    }
    return given;
  }

  [[nodiscard]] Vector limit_effort(const State& state, const Vector& asked,
                                    const Vector& stiffness = Vector::Zero(),
                                    const Vector& damping = Vector::Zero()) noexcept {
    if (!started_) return Vector::Zero();
    const auto step = limiter_.limit(limit_state_, state, asked, period_, stiffness, damping);
    limit_state_ = step.next;
    report_ = step.report;
    return step.next.effort;
  }

  [[nodiscard]] Command limit_multi_mode(const State& state, const Command& asked) noexcept {
    const Vector asked_total = spring_pull(asked, state) + asked.effort;
    if (!is_finite(asked_total) || !is_finite(asked)) {  // nothing but the effort that brakes
      Command braking;
      braking.effort = told(asked_total, limit_effort(state, Vector::Constant(not_a_number)));
      return braking;
    }
    Command given = asked;
    given.position = given.position.cwiseMax(limits_.lower).cwiseMin(limits_.upper);
    given.velocity = given.velocity.cwiseMax(-limits_.velocity).cwiseMin(limits_.velocity);
    given.stiffness = given.stiffness.cwiseMax(0);
    given.damping = given.damping.cwiseMax(0);
    const Vector total = spring_pull(given, state) + asked.effort;
    const Vector effort = limit_effort(state, total, given.stiffness, given.damping);
    for (int j = 0; j < joint_count; ++j) {
      JointLimitReport& report = report_[j];
      report.position = report.position || given.position[j] != asked.position[j];
      report.velocity = report.velocity || given.velocity[j] != asked.velocity[j];
      report.stiffness = given.stiffness[j] != asked.stiffness[j];
      report.damping = given.damping[j] != asked.damping[j];
      if (effort[j] == total[j] && std::abs(asked.effort[j]) <= limits_.effort[j]) continue;
      set_total(given, state, j, effort[j], limits_.effort[j]);
    }
    static_cast<void>(told(asked_total, effort));
    return given;
  }

  ControllerType controller_;
  CommandLimits<joint_count> limits_;
  [[no_unique_address]] Limiter limiter_;
  LimitState limit_state_{};
  LimitReport<joint_count> report_{};
  double period_ = 1e-3;
  Vector last_given_ = Vector::Zero();  ///< before the first update, if it goes on from there
  int unasked_cycles_ = 0;              ///< in a row, counted to one more than are borne with
  bool goes_on_ = false;
  bool started_ = false;
  bool failed_ = false;
};

}  // namespace articula
