// SPDX-License-Identifier: Apache-2.0
/// @file The control loop: one hardware, one controller, one cycle at a time.
#pragma once

#include "articula/control/laws/command_numbers.hpp"
#include "articula/control/laws/effort_law.hpp"
#include "articula/control/safety/resume.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/control/safety/tells_failure.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/refuse.hpp"
#include "articula/loop/controller_check.hpp"
#include "articula/model/robot.hpp"
#include "articula/tuning/gain_notices.hpp"

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace articula {

/// A control loop of one hardware and one controller, put together by the compiler.
///
///     Loop<Q2dSim, PidPlusGravity> loop;
///     loop.reference().position = {-1.0, 1.0};
///     while (loop.update() == Status::ok) { ... }
///
/// One cycle reads the joints, lets the controller compute, keeps the command within the robot's
/// effort limits and writes it. NaN and infinity never reach the hardware: whatever goes wrong, the
/// command that is written is a safe one (see safe_command) and the Status tells. A controller that
/// says it has failed (TellsFailure) is treated as one whose command is not finite; what Limited or
/// Groups make of a failure is written (SafeInFailure), and only the Status tells. So is what they
/// make of a reference that is not finite (BrakesWithoutReference): they brake within their limits.
///
/// After up to `borne_cycles` bad cycles in a row the controller goes on as if nothing had been: a
/// lost frame costs no integral. After more, or after one in which the hardware could not be read
/// or written, it starts anew with the first good one, since what it remembers is of a motion that
/// is over. So it does after cycles in which the hardware was not active (Status::inactive):
/// nothing winds up while no drive follows. Where reference or command were to blame and the joints
/// were held meanwhile, it begins with the command that held them, if it can (see Primable). Where
/// something was given, the controller receives what was given last, if it takes that (TakesGiven).
///
/// A controller that is no template goes in by `Loop loop{hardware, Mine{}}`.
/// @tparam HardwareType        satisfies Hardware
/// @tparam ControllerTemplate  makes a Controller of the hardware's robot
template <class HardwareType, template <class> class ControllerTemplate>
class Loop {
 public:
  using RobotType = typename detail::RobotOf<HardwareType>::Type;
  using ControllerType = ControllerTemplate<RobotType>;
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
  Loop()
    requires std::default_initializable<HardwareType>
      : Loop(HardwareType(), detail::default_controller<ControllerType>()) {}

  /// A given controller on default hardware.
  explicit Loop(ControllerType controller)
    requires std::default_initializable<HardwareType>
      : Loop(HardwareType(), std::move(controller)) {}

  /// Given hardware under the default controller.
  explicit Loop(HardwareType hardware)
      : Loop(std::move(hardware), detail::default_controller<ControllerType>()) {}

  /// Activates the hardware, reads where the joints are and makes that the reference. The period is
  /// the hardware's own, 1 ms if it has none.
  /// @param hardware    the joints
  /// @param controller  with its gains
  /// @throws std::invalid_argument if the hardware's period is not a positive number
  /// @throws std::runtime_error if the hardware cannot be activated
  Loop(HardwareType hardware, ControllerType controller)
      : Loop(std::move(hardware), std::move(controller), std::optional<double>()) {}

  /// Likewise, with a given period.
  /// @param hardware    the joints
  /// @param controller  with its gains
  /// @param period      time between two updates [s]
  /// @throws std::invalid_argument if the period is not a positive number, or not that which the
  ///         hardware dictates
  /// @throws std::runtime_error if the hardware cannot be activated
  Loop(HardwareType hardware, ControllerType controller, double period)
      : Loop(std::move(hardware), std::move(controller), std::optional<double>(period)) {}

  /// One cycle: read, control, limit, write. The first good cycle starts the controller; joints
  /// whose reference position is still that of construction are to stay where they are measured.
  /// @return Status::ok, or the first thing that went wrong; the command that was written is safe
  ///         either way
  /// Real-time: yes, if the hardware's read and write are.
  [[nodiscard]] Status update() noexcept {
    time_ = next_time();
    ++cycles_;

    if (nothing_given_) forget_position();
    const Status read = hardware_.read(state_);
    Status status = read;
    if (status == Status::ok && !is_finite(state_)) status = Status::non_finite_state;
    if (status == Status::ok && !started_) start();
    if (status == Status::ok && !is_finite(reference_)) status = Status::non_finite_reference;
    Command command;
    bool controls = status == Status::ok || (status == Status::non_finite_reference &&
                                             BrakesWithoutReference<ControllerType>);
    bool fails = false;
    if (controls) {
      if (bad_cycles_ > borne_cycles) restart();
      command = controller_.update(state_, reference_, period_);
      fails = has_failed(controller_);
      controls = is_finite(command) && command_counts(controller_);
      if (!controls && status == Status::ok) status = Status::non_finite_command;
    }
    command_ = controls ? limited(hardware_.robot(), command)
                        : safe_command(hardware_.robot(), trusted_position(read), command_);

    // A position command before any position is known is not finite.
    const Status write = is_finite(command_) ? hardware_.write(command_) : Status::ok;
    if (status == Status::ok) status = write;
    note(status, controls, read, write);
    return status == Status::ok && fails ? Status::non_finite_command : status;
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
  [[nodiscard]] ControllerType& controller() noexcept { return controller_; }
  [[nodiscard]] const ControllerType& controller() const noexcept { return controller_; }
  [[nodiscard]] HardwareType& hardware() noexcept { return hardware_; }
  [[nodiscard]] const HardwareType& hardware() const noexcept { return hardware_; }

 private:
  Loop(HardwareType hardware, ControllerType controller, std::optional<double> period)
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

  void start() noexcept {
    for (int j = 0; j < joint_count; ++j) {
      const bool untouched = is_finite(initial_position_[j])
                                 ? reference_.position[j] == initial_position_[j]
                                 : !is_finite(reference_.position[j]);
      if (untouched) reference_.position[j] = state_.position[j];
    }
    controller_.start(state_);
    started_ = true;
    bad_cycles_ = 0;
  }

  /// What is remembered of the bad cycles before a good one. One in which the controller's own
  /// command was written is good.
  void note(Status status, bool controls, Status read, Status write) noexcept {
    if (controls && write == Status::ok) {
      bad_cycles_ = 0;
      joints_lost_ = nothing_given_ = false;
      return;
    }
    if (bad_cycles_ <= borne_cycles) ++bad_cycles_;
    const bool uncontrolled = read == Status::hardware_fault || read == Status::inactive;
    if (uncontrolled || write != Status::ok) bad_cycles_ = borne_cycles + 1;
    joints_lost_ = joints_lost_ || read != Status::ok || write != Status::ok ||
                   status == Status::non_finite_state;
    nothing_given_ = read == Status::inactive || write == Status::inactive;
  }

  /// Hardware that is not active may leave the state alone. A position from before is none to hold.
  void forget_position() noexcept {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    state_.position.setConstant(unknown);
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      command_.position.setConstant(unknown);
    }
  }

  void restart() noexcept {
    controller_.start(state_);
    if constexpr (TakesGiven<ControllerType, joint_count>) {
      if (!nothing_given_) controller_.given(numbers_of(command_, state_));
    }
    if constexpr (Primable<ControllerType, joint_count>) {
      if (joints_lost_ || !is_finite(reference_)) return;
      static_cast<void>(detail::prime(controller_, state_, reference_, period_,
                                      numbers_of(command_, state_), LastCommand::load));
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
  ControllerType controller_;
  double period_;
  double time_ = 0;
  std::uint64_t cycles_ = 0;
  bool started_ = false;
  int bad_cycles_ = 0;          ///< in a row, counted to one more than are borne with
  bool joints_lost_ = false;    ///< in one of them the joints were not known or not held
  bool nothing_given_ = false;  ///< in the last of them no drive was active
  State state_{};
  Reference reference_{};
  Command command_{};
  JointVector<joint_count> initial_position_;
};

/// A loop of a controller that is no template.
template <class HardwareType, class C>
Loop(HardwareType, C) -> Loop<HardwareType, detail::OfAnyRobot<C>::template Controller>;
/// @copydoc Loop(HardwareType, C)
template <class HardwareType, class C>
Loop(HardwareType, C, double) -> Loop<HardwareType, detail::OfAnyRobot<C>::template Controller>;

}  // namespace articula
