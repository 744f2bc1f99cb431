// SPDX-License-Identifier: Apache-2.0
/// @file The control loop: one hardware, one controller, one cycle at a time.
#pragma once

#include "articula/control/safety/safe_command.hpp"
#include "articula/core/controller.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/scalar.hpp"
#include "articula/loop/command_history.hpp"
#include "articula/loop/cycle_input.hpp"
#include "articula/loop/loop_parts.hpp"
#include "articula/loop/loop_set_up.hpp"
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
/// or after one in which the hardware could not be read or written, the motion that the controller
/// remembers is over. The first good cycle then starts the controller again. So does the first
/// one after cycles in which the hardware was not active (Status::inactive). Where the joints were
/// held meanwhile, the controller starts with the command that held them.
///
/// Several robots of a kind run in one loop where hardware and controller are over packs:
/// `Loop<Simulator<R, symbolic::Pack<>>, Pid>`. They share the Status. Where one robot's state,
/// reference or command is not finite, the cycle is bad for all, and each gets its safe command.
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
  using Scalar = ScalarOf<HardwareType>;
  using State = JointState<joint_count, Scalar>;
  using Reference = JointReference<joint_count, Scalar>;
  using Command = typename detail::CheckedController<ControllerType, joint_count, Scalar>::Command;
  static_assert(!Controller<ControllerType, joint_count, Scalar> ||
                    detail::TakesCommand<HardwareType, Command>,
                "the hardware does not take this controller's kind of command: give it drives that "
                "do, such as MockHardware<R, PositionCommand<N>> for positions, or choose another "
                "controller");
  static_assert(!Controller<ControllerType, joint_count, Scalar> ||
                    !detail::TakesCommand<HardwareType, Command> || Hardware<HardwareType, Command>,
                "the hardware lacks something: robot(), activate(), deactivate(), or noexcept "
                "read(state) and write(command) that return a Status, see core/hardware.hpp");

  /// Default hardware and controller.
  ControlLoop()
    requires std::default_initializable<HardwareType>
      : ControlLoop(HardwareType(), detail::default_controller<C>()) {}

  /// A controller on default hardware.
  explicit ControlLoop(C controller)
    requires std::default_initializable<HardwareType>
      : ControlLoop(HardwareType(), std::move(controller)) {}

  /// Given hardware under the default controller.
  explicit ControlLoop(HardwareType hardware)
      : ControlLoop(std::move(hardware), detail::default_controller<C>()) {}

  /// Activates the hardware, reads where the joints are and makes that the reference.
  /// @param hardware    the joints
  /// @param controller  with its gains
  /// @param period      time between two updates [s]; by default the hardware's own, 1 ms if it has
  ///                    none
  /// @throws std::invalid_argument if the period is not a positive number, or not that which the
  ///         hardware dictates
  /// @throws std::runtime_error if the hardware cannot be activated, with its fault
  ControlLoop(HardwareType hardware, C controller, std::optional<double> period = {})
      : hardware_(std::move(hardware)),
        controller_(std::move(controller)),
        period_(detail::loop_period(hardware_, period)) {
    detail::activate(hardware_);
    input_.read = hardware_.read(state_);
    const bool known = input_.read == Status::ok && all_of(is_finite(state_.position));
    initial_position_ = known ? state_.position : Vector(Vector::Constant(unknown));
    reference_.position = initial_position_;
    followed_ = reference_;
    hold_position(initial_position_);
  }

  /// One cycle: read, control, limit, write. The first good cycle starts the controller; joints
  /// whose reference position is still that of construction are to stay where they are measured.
  /// @return Status::ok, or the first thing that went wrong; the command that was written is safe
  ///         either way
  /// Real-time: yes, if the hardware's read and write, and the controller, are.
  [[nodiscard]] Status update() noexcept {
    time_ = next_time();
    ++cycles_;

    if (history_.held() == Held::nothing) forget_position();
    const Status read = hardware_.read(state_);
    Status status = read;
    if (status == Status::ok && !all_of(is_finite(state_))) status = Status::non_finite_state;
    const bool known = status == Status::ok;
    if (known && !started_) begin();
    if (known && !all_of(is_finite(reference_))) status = Status::non_finite_reference;
    followed_ = reference_;
    const bool has_reference = status == Status::ok;
    const bool calls = has_reference || (known && Brakes<C, joint_count, Scalar>);
    Outcome<Command> outcome;
    if (calls) {
      if (history_.must_start()) {
        start(has_reference ? history_.held() : std::min(history_.held(), Held::unsure));
      }
      const auto in = history_.input(state_, reference_, period_);
      outcome =
          has_reference ? update_controller(controller_, in) : brake_controller(controller_, in);
    }
    const bool controls = outcome.verdict != Verdict::failed;
    if (calls && !controls && status == Status::ok) status = Status::non_finite_command;
    command_ = controls ? within_effort_limits(hardware_.robot(), outcome.command)
                        : safe_command(hardware_.robot(), trusted_position(read), command_);

    // A position command before any position is known is not finite.
    const Status write = all_of(is_finite(command_)) ? hardware_.write(command_) : Status::ok;
    input_ = {.read = read, .write = write};
    if (calls) history_.note_command(outcome, command_, state_);
    if (status == Status::ok) status = write;
    history_.note_cycle(controls, known, read, write);
    const bool is_degraded = status == Status::ok && outcome.verdict == Verdict::degraded;
    return is_degraded ? Status::non_finite_command : status;
  }

  /// What the joints shall do; may be changed between two updates.
  [[nodiscard]] Reference& reference() noexcept { return reference_; }
  [[nodiscard]] const Reference& reference() const noexcept { return reference_; }
  /// The reference of the last update, from which command() was made: reference() may already be
  /// that of the next one.
  [[nodiscard]] const Reference& followed() const noexcept { return followed_; }
  /// What else came into the last update.
  [[nodiscard]] const CycleInput& input() const noexcept { return input_; }
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
  /// @param lane  of a pack, the robot whose position it is
  /// Real-time: no (allocates).
  [[nodiscard]] std::vector<std::string> notices(int lane = 0) const {
    JointVector<joint_count> position = lane_of(state_.position, lane);
    if (!is_finite(position)) position.setZero();
    return gain_notices(hardware_.robot(), controller_, position, period_);
  }
  [[nodiscard]] C& controller() noexcept { return controller_; }
  [[nodiscard]] const C& controller() const noexcept { return controller_; }
  [[nodiscard]] HardwareType& hardware() noexcept { return hardware_; }
  [[nodiscard]] const HardwareType& hardware() const noexcept { return hardware_; }

 private:
  using Vector = JointVector<joint_count, Scalar>;
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// The first cycle with a good state. Joints of which no reference was set stay there.
  [[gnu::cold]] void begin() noexcept {
    for (int j = 0; j < joint_count; ++j) {
      const Scalar &initial = initial_position_[j], asked = reference_.position[j],
                   here = state_.position[j];
      reference_.position[j] = select(is_finite(initial), select(asked == initial, here, asked),
                                      select(is_finite(asked), asked, here));
    }
    start(Held::nothing);
    started_ = true;
    history_.begin();
  }

  /// Starts the controller with what the last command has done. Where the reference is not finite,
  /// it starts with that of joints that stay.
  [[gnu::cold]] void start(Held held) noexcept {
    history_.start_with(command_, state_, held);
    const Reference here{.position = state_.position};
    const Reference& reference = all_of(is_finite(reference_)) ? reference_ : here;
    start_controller(controller_, history_.input(state_, reference, period_));
  }

  /// Hardware that is not active may leave the state alone. A position from before is none to hold.
  void forget_position() noexcept {
    state_.position.setConstant(unknown);
    hold_position(state_.position);
  }

  /// The position of a safe position command while none is measured.
  void hold_position(const Vector& position) noexcept {
    if constexpr (std::same_as<Command, PositionCommand<joint_count, Scalar>>) {
      command_.position = position;
    }
  }

  /// The position that a safe command may build on: none where the hardware could not be read.
  [[nodiscard]] Vector trusted_position(Status read) const noexcept {
    return read == Status::hardware_fault ? Vector(Vector::Constant(unknown)) : state_.position;
  }

  HardwareType hardware_;
  C controller_;
  double period_;
  double time_ = 0;
  std::uint64_t cycles_ = 0;
  bool started_ = false;
  CommandHistory<Command> history_;
  State state_{};
  Reference reference_{};
  Reference followed_{};
  CycleInput input_{};
  Command command_{};
  Vector initial_position_;
};

}  // namespace articula
