// SPDX-License-Identifier: Apache-2.0
/// @file The control loop: one hardware, one controller, one cycle at a time.
#pragma once

#include "articula/control/laws/command_numbers.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/refuse.hpp"
#include "articula/loop/controller_check.hpp"
#include "articula/model/robot.hpp"
#include "articula/tuning/gain_notices.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace articula {

/// A control loop of one hardware and one controller, put together by the compiler:
///
///     ControlLoop loop{Q2dSim(), [](const ControlInput<2>& in) noexcept {
///       return EffortCommand<2>{5 * (in.reference.position - in.state.position)};
///     }};
///     while (loop.update() == Status::ok) { ... }
///
/// One cycle reads the joints, lets the controller compute, keeps the command within the robot's
/// effort limits and writes it. NaN and infinity never reach the hardware. Where something is
/// wrong, a safe command is written (see safe_command), and the Status says what:
///
/// - The controller's verdict is `failed`: the safe command is written. It is `degraded`: the
///   controller's command is written. The Status is non_finite_command.
/// - The reference is not finite: a controller that can brakes the joints within its limits (see
///   Brakes). Any other is not called.
/// - The state is not finite, or not known: the controller is not called.
///
/// Up to `borne_cycles` consecutive bad cycles leave the controller's state unchanged. After more,
/// or after one in which the hardware could not be read or written, the first good cycle starts the
/// controller again, since its memory is of a motion that is over. So does the first one after
/// cycles in which the hardware was not active (Status::inactive). Where the joints were held
/// meanwhile, the controller starts with the command that held them.
///
/// For a robot that people work beside, see SupervisedControlLoop.
/// @tparam HardwareType  satisfies Hardware
/// @tparam C             satisfies Controller
template <class HardwareType, class C>
class ControlLoop {
 public:
  using RobotType = typename detail::RobotOf<HardwareType>::Type;
  using ControllerType = C;
  static constexpr int joint_count = articula::joint_count<RobotType>;
  /// Bad cycles in a row over which the controller's memory is kept.
  static constexpr int borne_cycles = detail::borne_cycles;
  using State = JointState<joint_count>;
  using Reference = JointReference<joint_count>;
  using Command = typename detail::CheckedController<ControllerType, joint_count>::Command;
  static_assert(!Controller<ControllerType, joint_count> ||
                    detail::TakesCommand<HardwareType, Command>,
                "the hardware does not take this controller's kind of command: give it drives that "
                "do, such as MockHardware<R, PositionCommand<N>> for positions, or choose another "
                "controller");
  static_assert(!Controller<ControllerType, joint_count> ||
                    !detail::TakesCommand<HardwareType, Command> || Hardware<HardwareType, Command>,
                "the hardware lacks something: robot(), activate(), deactivate(), or noexcept "
                "read(state) and write(command) that return a Status, see core/hardware.hpp");

  /// Default hardware and controller.
  ControlLoop()
    requires std::default_initializable<HardwareType>
      : ControlLoop(HardwareType(), detail::default_controller<C>()) {}

  /// A given controller on default hardware.
  explicit ControlLoop(C controller)
    requires std::default_initializable<HardwareType>
      : ControlLoop(HardwareType(), std::move(controller)) {}

  /// Given hardware under the default controller.
  explicit ControlLoop(HardwareType hardware)
      : ControlLoop(std::move(hardware), detail::default_controller<C>()) {}

  /// Activates the hardware, reads where the joints are and makes that the reference. The period is
  /// the hardware's own, 1 ms if it has none.
  /// @param hardware    the joints
  /// @param controller  with its gains
  /// @throws std::invalid_argument if the hardware's period is not a positive number
  /// @throws std::runtime_error if the hardware cannot be activated
  ControlLoop(HardwareType hardware, C controller)
      : ControlLoop(std::move(hardware), std::move(controller), std::optional<double>()) {}

  /// Likewise, with a given period.
  /// @param hardware    the joints
  /// @param controller  with its gains
  /// @param period      time between two updates [s]
  /// @throws std::invalid_argument if the period is not a positive number, or not that which the
  ///         hardware dictates
  /// @throws std::runtime_error if the hardware cannot be activated
  ControlLoop(HardwareType hardware, ControllerType controller, double period)
      : ControlLoop(std::move(hardware), std::move(controller), std::optional<double>(period)) {}

  /// One cycle: read, control, limit, write. The first good cycle starts the controller; joints
  /// whose reference position is still that of construction are to stay where they are measured.
  /// @return Status::ok, or the first thing that went wrong; the command that was written is safe
  ///         either way
  /// Real-time: yes, if the hardware's read and write, and the controller, are.
  [[nodiscard]] Status update() noexcept {
    time_ = next_time();
    ++cycles_;

    if (held_ == Held::nothing) forget_position();
    const Status read = hardware_.read(state_);
    Status status = read;
    if (status == Status::ok && !is_finite(state_)) status = Status::non_finite_state;
    if (status == Status::ok && !started_) begin();
    if (status == Status::ok && !is_finite(reference_)) status = Status::non_finite_reference;
    const bool has_reference = status == Status::ok;
    const bool calls =
        has_reference || (status == Status::non_finite_reference && Brakes<C, joint_count>);
    Outcome<Command> outcome;
    if (calls) {
      if (bad_cycles_ > borne_cycles) start(has_reference ? held_ : std::min(held_, Held::unsure));
      const ControlInput<joint_count> in{state_, reference_, period_, applied_, cut_};
      outcome =
          has_reference ? update_controller(controller_, in) : brake_controller(controller_, in);
    }
    const bool controls = outcome.verdict != Verdict::failed;
    if (calls && !controls && status == Status::ok) status = Status::non_finite_command;
    command_ = controls ? within_effort_limits(hardware_.robot(), outcome.command)
                        : safe_command(hardware_.robot(), trusted_position(read), command_);

    // A position command before any position is known is not finite.
    const Status write = is_finite(command_) ? hardware_.write(command_) : Status::ok;
    if (calls) remember(outcome);
    if (status == Status::ok) status = write;
    note(controls, read, write, status);
    const bool is_degraded = status == Status::ok && outcome.verdict == Verdict::degraded;
    return is_degraded ? Status::non_finite_command : status;
  }

  /// What the joints shall do; may be changed between two updates.
  [[nodiscard]] Reference& reference() noexcept { return reference_; }
  [[nodiscard]] const Reference& reference() const noexcept { return reference_; }
  /// What was measured at the beginning of the last update, before the first update at
  /// construction.
  [[nodiscard]] const State& state() const noexcept { return state_; }
  /// What was written at the end of the last update.
  [[nodiscard]] const Command& command() const noexcept { return command_; }
  /// The time to which state() and command() belong: 0 at the first update, then one period more
  /// each [s].
  [[nodiscard]] double time() const noexcept { return time_; }
  /// What time() will be after the next update, and so the time that its reference is for [s].
  [[nodiscard]] double next_time() const noexcept { return static_cast<double>(cycles_) * period_; }
  /// Time between two updates [s].
  [[nodiscard]] double period() const noexcept { return period_; }
  /// What the user should know before the robot moves, a line each: see gain_notices, for the
  /// position measured last. `run` with RealtimeOptions passes it to their `warn`.
  /// Real-time: no (allocates).
  [[nodiscard]] std::vector<std::string> notices() const {
    const JointVector<joint_count> nowhere = JointVector<joint_count>::Zero();
    const bool known = is_finite(state_.position);
    return gain_notices(hardware_.robot(), controller_, known ? state_.position : nowhere, period_);
  }
  [[nodiscard]] C& controller() noexcept { return controller_; }
  [[nodiscard]] const C& controller() const noexcept { return controller_; }
  [[nodiscard]] HardwareType& hardware() noexcept { return hardware_; }
  [[nodiscard]] const HardwareType& hardware() const noexcept { return hardware_; }

 private:
  ControlLoop(HardwareType hardware, ControllerType controller, std::optional<double> period)
      : hardware_(std::move(hardware)),
        controller_(std::move(controller)),
        period_(checked_period(hardware_, period)) {
    if (hardware_.activate() != Status::ok)
      throw std::runtime_error("loop: hardware cannot be activated");
    const bool known = hardware_.read(state_) == Status::ok && is_finite(state_.position);
    initial_position_ =
        known ? state_.position
              : JointVector<joint_count>::Constant(std::numeric_limits<double>::quiet_NaN());
    reference_.position = initial_position_;
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      command_.position = initial_position_;
    }
  }

  [[nodiscard]] static double checked_period(const HardwareType& hardware,
                                             std::optional<double> asked) {
    double period = asked.value_or(1e-3);
    if constexpr (requires { hardware.period(); }) period = hardware.period();
    if (!is_finite(period) || period <= 0) {
      detail::refuse({"loop: period ", period, " s is not a positive number"});
    }
    if (asked && *asked != period) {
      detail::refuse({"loop: period ", *asked, " s, but the hardware has ", period, " s"});
    }
    return period;
  }

  /// The first cycle with a good state. Joints of which no reference was set stay there.
  [[gnu::cold]] void begin() noexcept {
    for (int j = 0; j < joint_count; ++j) {
      const bool untouched = is_finite(initial_position_[j])
                                 ? reference_.position[j] == initial_position_[j]
                                 : !is_finite(reference_.position[j]);
      if (untouched) reference_.position[j] = state_.position[j];
    }
    start(Held::nothing);
    started_ = true;
    bad_cycles_ = 0;
    held_ = Held::load;
  }

  /// Starts the controller with what the last command has done. Where the reference is not finite, it
  /// starts with that of joints that stay.
  [[gnu::cold]] void start(Held held) noexcept {
    applied_ = {};
    if (held != Held::nothing) applied_ = {numbers_of(command_, state_), held};
    cut_.setZero();
    const Reference here{.position = state_.position};
    const Reference& reference = is_finite(reference_) ? reference_ : here;
    start_controller(controller_, ControlInput<joint_count>{state_, reference, period_, applied_});
  }

  /// What the controller learns in its next call about the command of this one.
  void remember(const Outcome<Command>& outcome) noexcept {
    applied_ = {numbers_of(command_, state_), Held::push};
    cut_.setZero();
    if constexpr (requires { command_.effort; }) {
      if (outcome.verdict != Verdict::failed) cut_ = outcome.command.effort - command_.effort;
    }
  }

  /// What is remembered of the bad cycles before a good one. A cycle in which the controller's own
  /// command was written is good.
  void note(bool controls, Status read, Status write, Status status) noexcept {
    if (controls && write == Status::ok) {
      bad_cycles_ = 0;
      held_ = Held::load;
      return;
    }
    if (bad_cycles_ <= borne_cycles) ++bad_cycles_;
    const bool uncontrolled = read == Status::hardware_fault || read == Status::inactive;
    if (uncontrolled || write != Status::ok) bad_cycles_ = borne_cycles + 1;
    const bool lost = read != Status::ok || write != Status::ok ||
                      status == Status::non_finite_state || held_ != Held::load;
    const bool inactive = read == Status::inactive || write == Status::inactive;
    held_ = inactive ? Held::nothing : lost ? Held::unsure : Held::load;
  }

  /// Hardware that is not active may leave the state alone. A position from before is none to hold.
  void forget_position() noexcept {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    state_.position.setConstant(unknown);
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      command_.position.setConstant(unknown);
    }
  }

  /// The position that a safe command may build on: none where the hardware could not be read.
  [[nodiscard]] JointVector<joint_count> trusted_position(Status read) const noexcept {
    if (read == Status::hardware_fault) {
      return JointVector<joint_count>::Constant(std::numeric_limits<double>::quiet_NaN());
    }
    return state_.position;
  }

  HardwareType hardware_;
  C controller_;
  double period_;
  double time_ = 0;
  std::uint64_t cycles_ = 0;
  bool started_ = false;
  int bad_cycles_ = 0;              ///< in a row, counted to one more than are borne
  Held held_ = Held::unsure;        ///< what the last command has done
  Applied<joint_count> applied_{};  ///< at the controller's last call
  JointVector<joint_count> cut_ = JointVector<joint_count>::Zero();  ///< likewise
  State state_{};
  Reference reference_{};
  Command command_{};
  JointVector<joint_count> initial_position_;
};

}  // namespace articula
