// SPDX-License-Identifier: Apache-2.0
/// @file The gate of a supervised loop: judges each measurement, and lets allowed commands through.
#pragma once

#include "articula/control/safety/damping_effort.hpp"
#include "articula/control/safety/safe_command.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/loop/supervision/supervision_options.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <cstddef>
#include <utility>

namespace articula {

/// Which commands reach the hardware.
enum class Passage : unsigned char {
  closed,     ///< none: the hardware is not active
  command,    ///< the loop's commands
  behaviour,  ///< the safe behaviour in place of the loop's commands
};

/// Keeps commands from drives that must not move, and replaces them by a safe behaviour in a fault.
/// SupervisedControlLoop puts it around its hardware:
///
///     gate.open(Passage::behaviour, Status::inactive);   // a fault: the safe behaviour
///     gate.verdict();                                    // the last measurement's status
///
/// - `read` judges each measurement: is it finite, and within the robot's limits and the margins?
/// - `write` sends the command, the safe behaviour, or nothing, as `open` has set.
///
/// Do not use it by itself. It changes its mode only on request, and it activates no hardware.
/// For a loop with faults and their acknowledgement, use SupervisedLoop.
/// @tparam HardwareType  what is supervised
/// @tparam CommandType   what it accepts
template <class HardwareType, class CommandType>
  requires Hardware<HardwareType, CommandType>
class SupervisedHardware {
 public:
  using RobotType = typename HardwareType::RobotType;
  static constexpr int joint_count = articula::joint_count<RobotType>;

  SupervisedHardware(HardwareType hardware, const SupervisionOptions& options)
      : hardware_(std::move(hardware)), options_(options) {}

  [[nodiscard]] const RobotType& robot() const noexcept { return hardware_.robot(); }
  [[nodiscard]] double period() const noexcept
    requires requires(const HardwareType& h) { h.period(); }
  {
    return hardware_.period();
  }

  /// Does nothing: the supervised loop activates the hardware later, on request.
  [[nodiscard]] Status activate() noexcept { return Status::ok; }
  [[nodiscard]] Status deactivate() noexcept { return Status::ok; }

  /// Reads a measurement and judges it. Real-time: yes, if the hardware's read is.
  /// @return the fault of the measurement; without a fault, the status that `open` has set
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    verdict_ = hardware_.read(state);
    if (verdict_ == Status::ok && !is_finite(state)) verdict_ = Status::non_finite_state;
    if (verdict_ == Status::ok && beyond_limits(state)) verdict_ = Status::limit_exceeded;
    state_ = state;
    return verdict_ == Status::ok ? answer_ : verdict_;
  }

  /// Sends what the passage allows. Real-time: yes, if the hardware's write is.
  [[nodiscard]] Status write(const CommandType& command) noexcept {
    if (passage_ == Passage::closed) return Status::ok;
    written_ = passage_ == Passage::behaviour ? safe_behaviour(command) : command;
    has_written_ = true;
    return hardware_.write(written_);
  }

  /// Sets which commands reach the hardware from now on. Real-time: yes.
  /// @param passage  the commands that are let through
  /// @param answer   status that `read` returns without a fault; any other than Status::ok keeps
  ///                 the loop from calling the controller
  void open(Passage passage, Status answer) noexcept {
    passage_ = passage;
    answer_ = answer;
    if (passage == Passage::closed) has_written_ = false;
  }

  [[nodiscard]] Passage passage() const noexcept { return passage_; }
  /// The status of the last measurement.
  [[nodiscard]] Status verdict() const noexcept { return verdict_; }
  /// The command that the hardware got last.
  [[nodiscard]] const CommandType& written() const noexcept { return written_; }
  [[nodiscard]] HardwareType& hardware() noexcept { return hardware_; }
  [[nodiscard]] const HardwareType& hardware() const noexcept { return hardware_; }

 private:
  [[nodiscard]] bool beyond_limits(const JointState<joint_count>& state) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      const JointLimits& limits = model_of(robot()).joints[j].limits;
      const double q = state.position[j], v = state.velocity[j];
      const double most = limits.velocity * (1 + options_.velocity_margin);
      if (q < limits.lower - options_.position_margin) return true;
      if (q > limits.upper + options_.position_margin) return true;
      if (v > most || v < -most) return true;
    }
    return false;
  }

  /// @param command  the loop's own safe command, for a state that cannot be trusted
  [[nodiscard]] CommandType safe_behaviour(const CommandType& command) const noexcept {
    const bool trusted = verdict_ == Status::ok || verdict_ == Status::limit_exceeded;
    if constexpr (std::same_as<CommandType, EffortCommand<joint_count>>) {
      if (options_.behaviour == SafeBehaviour::zero_effort) return {};
      if (!trusted) return command;
      CommandType damped{
          damping_effort(robot(), state_.position, state_.velocity, options_.damping_time)};
      return is_finite(damped) ? within_effort_limits(robot(), damped) : CommandType{};
    } else if constexpr (std::same_as<CommandType, MultiModeCommand<joint_count>>) {
      return options_.behaviour == SafeBehaviour::zero_effort ? CommandType{} : command;
    } else if constexpr (std::same_as<CommandType, PositionCommand<joint_count>>) {
      return has_written_ ? written_ : command;  // the measured position would creep
    } else {
      return command;  // zero velocity
    }
  }

  HardwareType hardware_;
  SupervisionOptions options_;
  Passage passage_ = Passage::closed;
  Status answer_ = Status::inactive;
  Status verdict_ = Status::inactive;
  JointState<joint_count> state_{};
  CommandType written_{};
  bool has_written_ = false;
};

}  // namespace articula
