// SPDX-License-Identifier: Apache-2.0
/// @file A controller whose commands keep limits.
#pragma once

#include "articula/command/command_numbers.hpp"
#include "articula/control/laws/valid_gains.hpp"
#include "articula/control/limits/lane_limiters.hpp"
#include "articula/core/controller_check.hpp"
#include "articula/core/scalar.hpp"

#include <cmath>
#include <concepts>
#include <exception>
#include <limits>
#include <utility>

namespace articula {

/// A controller whose commands keep limits of position, velocity, acceleration, jerk and effort. So
/// every joint can always stop before its position limit (see limit_motion):
///
///     CommandLimits<2> limits = command_limits(Q2d());
///     limits.acceleration = {20, 40};  // what the drives can do in every posture
///     Loop loop{Q2dSim(), Limited(Q2d(), limits, PidPlusGravity<Q2d>())};
///
/// - Position commands: limits hold for the commands, which begin at the measured position.
/// - Velocity commands: likewise, at the measured position; a drive that lags needs some room.
/// - Effort commands: limits hold for the motion that the model foresees (see EffortLimiter).
/// - Multi-mode commands: likewise, for the total effort at the measured state. Where it is too
///   much, the drive's references are drawn towards the state.
///
/// A command within the limits passes unchanged. If the controller has failed, all joints brake and
/// the verdict is `degraded`. A reference that is not finite brakes all joints, too, and the
/// controller is not called. After more than three such cycles in a row it is started again, with
/// the command that held the joints.
///
/// Limits of effort alone need no Limited: loops and SumController keep those.
///
/// The robots of a pack have the same limits, and each keeps them by itself. They share the
/// verdict: where the controller fails for one robot, all robots brake.
/// @tparam R  the robot
/// @tparam C  the controller, satisfies Controller
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class C, class S = ScalarOf<C>>
class Limited {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Scalar = S;
  using Command = typename detail::CheckedController<C, joint_count, S>::Command;
  using Input = ControlInput<joint_count, S>;

  /// The limits of the robot's description. (For efforts it does not say enough.)
  Limited()
    requires DescribedRobot<R> && std::default_initializable<C> &&
             (!requires(Command command) { command.effort; })
      : Limited(command_limits(R())) {}

  /// @param robot       whose joints these are
  /// @param limits      to keep
  /// @param controller  whose commands are limited
  /// @throws std::invalid_argument naming joint, limit and value if a limit makes no sense, is
  ///         beyond what the description says, or is missing (see EffortLimiter)
  Limited(const R& robot, const CommandLimits<articula::joint_count<R>>& limits, C controller)
      : controller_(std::move(controller)), limiters_((validate(robot, limits), robot), limits) {}
  /// With a controller that is made from the robot, or by default where none can be.
  Limited(const R& robot, const CommandLimits<articula::joint_count<R>>& limits)
      : Limited(robot, limits, controller_of(robot)) {}
  /// For a robot known at compile time.
  Limited(const CommandLimits<articula::joint_count<R>>& limits, C controller)
    requires DescribedRobot<R>
      : Limited(R(), limits, std::move(controller)) {}
  /// @copydoc Limited(const CommandLimits<articula::joint_count<R>>&, C)
  explicit Limited(const CommandLimits<articula::joint_count<R>>& limits)
    requires DescribedRobot<R>
      : Limited(R(), limits) {}

  /// Starts the controller. The limits begin at the measured state, those of `effort_rate` at the
  /// effort that was applied last. Real-time: yes, if the controller's is.
  void start(const Input& in) noexcept {
    start_controller(controller_, in);
    limiters_.start(in);
    clip_.setZero();
    passes_cut_ = false;
    braked_cycles_ = 0;
  }

  /// The controller's command within the limits. Real-time: yes, if the controller's is.
  [[nodiscard]] Outcome<Command> update(const Input& in) noexcept {
    Input inner{in.state, in.reference, in.period, in.applied, clip_};
    if (passes_cut_) inner.cut += in.cut;
    if (braked_cycles_ > detail::borne_cycles) {
      inner.applied = {limited_, Held::load};
      inner.cut.setZero();
      start_controller(controller_, inner);
    }
    braked_cycles_ = 0;
    const Outcome<Command> own = update_controller(controller_, inner);
    const Vector asked = numbers_of(own.command, in.state);
    passes_cut_ = own.verdict != Verdict::failed && all_of(is_finite(asked));
    if (!passes_cut_) {
      clip_.setZero();
      return {braked(in, asked), Verdict::degraded};
    }
    Command command = own.command;
    note(asked, limiters_.limit(in, command));
    clip_ = asked - limited_;
    return {command, own.verdict};
  }

  /// Brakes all joints; the controller is not called. Real-time: yes.
  [[nodiscard]] Outcome<Command> brake(const Input& in) noexcept {
    if (passes_cut_) clip_ += in.cut;  // of the controller's last command, for its next call
    passes_cut_ = false;
    if (braked_cycles_ <= detail::borne_cycles) ++braked_cycles_;
    return braked(in, Vector::Constant(std::numeric_limits<double>::quiet_NaN()));
  }

  /// What the last update changed.
  /// @param lane  of a pack, the robot whose command it is
  /// Real-time: yes.
  [[nodiscard]] const LimitReport<joint_count>& report(int lane = 0) const noexcept {
    return limiters_.report(lane);
  }
  [[nodiscard]] const CommandLimits<joint_count>& limits() const noexcept {
    return limiters_.limits();
  }
  [[nodiscard]] C& controller() noexcept { return controller_; }
  [[nodiscard]] const C& controller() const noexcept { return controller_; }

  /// The controller as a part; see HasParts.
  static auto parts(auto& self) noexcept { return std::tie(self.controller_); }

 private:
  using Vector = JointVector<joint_count, S>;

  [[nodiscard]] static C controller_of(const R& robot) {
    if constexpr (std::constructible_from<C, const R&>) {
      return C(robot);
    } else if constexpr (std::default_initializable<C>) {
      return C();
    } else {
      static_assert(std::default_initializable<C>,
                    "Limited cannot make this controller from the robot alone: pass the "
                    "controller behind the limits");
      std::terminate();
    }
  }

  [[nodiscard]] Command braked(const Input& in, const Vector& asked) noexcept {
    Command command;
    note(asked, limiters_.brake(in, command));
    return command;
  }

  /// Notes the numbers of a command and what became of them.
  void note(const Vector& asked, const Vector& limited) noexcept {
    for (int k = 0; k < lanes<S>; ++k) {
      for (int j = 0; j < joint_count; ++j) {
        note(limiters_.report(k)[j], lane_of(asked[j], k), lane_of(limited[j], k));
      }
    }
    limited_ = limited;
  }
  static void note(JointLimitReport& report, double asked, double limited) noexcept {
    // A change by rounding is not reported. What is no number always is, and so is a stiffness or
    // damping that has changed, though it may pull nothing at this state.
    if (std::abs(asked - limited) <= 1e-12 * (1 + std::abs(limited))) {
      report = {.stiffness = report.stiffness,
                .damping = report.damping,
                .non_finite = report.non_finite};
    }
    report.asked = asked;
    report.limited = limited;
  }

  C controller_;
  detail::LaneLimiters<R, Command, S> limiters_;
  Vector limited_ = Vector::Zero();  ///< numbers of the last command, at which the joints are held
  Vector clip_ = Vector::Zero();     ///< of the controller's last command, by these limits
  bool passes_cut_ = false;          ///< the last command was the controller's, within limits
  int braked_cycles_ = 0;            ///< without a reference, counted to one more than are borne
};

}  // namespace articula
