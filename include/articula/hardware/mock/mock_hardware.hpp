// SPDX-License-Identifier: Apache-2.0
/// @file Hardware that is not there.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/hardware/mock/mock_fault.hpp"
#include "articula/model/dynamic_robot.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula {

namespace detail {

/// What a mock takes unless it is said: positions where the robot has no masses, else efforts.
template <Robot R>
using MockCommand = std::conditional_t<is_kinematic<R>, PositionCommand<joint_count<R>>,
                                       EffortCommand<joint_count<R>>>;

}  // namespace detail

/// Hardware that is not there: joints that do at once what they are told, without any dynamics, and
/// fail by a script. For trying out everything around a robot.
///
/// A position command is where the joints are from then on, and their velocity is the step over the
/// period; a velocity command moves them by one period; an effort command shows as measured effort.
/// A multi-mode command does each of these: joints with a spring go where it pulls them, those with
/// a damper alone move with its velocity, and all show the effort.
/// Commands move joints while the hardware is active; a command that is not finite is refused.
/// @tparam R            the robot
/// @tparam CommandType  what the drives take; by default efforts, of a kinematic robot positions
template <Robot R, JointCommand<joint_count<R>> CommandType = detail::MockCommand<R>>
class MockHardware {
 public:
  using RobotType = R;
  using Command = CommandType;
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot   whose joints these are
  /// @param script  what goes wrong and when
  /// @param period  time from one command to the next [s]
  /// @throws std::invalid_argument if a fault names a joint that the robot does not have, or the
  ///         period is not a positive number
  explicit MockHardware(const R& robot, std::vector<MockFault> script = {}, double period = 1e-3)
      : robot_(robot), script_(std::move(script)), period_(period) {
    validate(script_, joint_count, period_);
  }
  /// For a robot known at compile time.
  explicit MockHardware(std::vector<MockFault> script = {}, double period = 1e-3)
    requires DescribedRobot<R>
      : MockHardware(R(), std::move(script), period) {}

  /// Status::hardware_fault if the script says so, else Status::ok. Real-time: yes.
  [[nodiscard]] Status activate() noexcept {
    active_ = !now(MockFaultKind::refuses_activation);
    return active_ ? Status::ok : Status::hardware_fault;
  }
  /// Real-time: yes.
  [[nodiscard]] Status deactivate() noexcept {
    active_ = false;
    return Status::ok;
  }

  /// Measures, as far as the script allows. One more reading of the script's count. Figures of
  /// hardware that is not active come with Status::inactive.
  /// Real-time: yes. O(N + length of the script).
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    const std::uint64_t reading = readings_++;
    Status status = Status::ok;
    JointState<joint_count> fresh = joints_;
    for (const MockFault& fault : script_) {
      if (!fault.covers(reading)) continue;
      switch (fault.kind) {
        case MockFaultKind::fails_to_read:
          return Status::hardware_fault;
        case MockFaultKind::goes_silent:
          status = Status::stale_state;
          if (fault.joint < 0) {
            fresh = measured_;
          } else {
            fresh.position[fault.joint] = measured_.position[fault.joint];
            fresh.velocity[fault.joint] = measured_.velocity[fault.joint];
            fresh.effort[fault.joint] = measured_.effort[fault.joint];
          }
          break;
        case MockFaultKind::measures_nan:
          spoil(fresh.position, fault.joint, std::numeric_limits<double>::quiet_NaN());
          break;
        case MockFaultKind::measures_position:
          spoil(fresh.position, fault.joint, fault.value);
          break;
        case MockFaultKind::measures_velocity:
          spoil(fresh.velocity, fault.joint, fault.value);
          break;
        case MockFaultKind::refuses_activation:
        case MockFaultKind::fails_to_write:
          break;
      }
    }
    measured_ = fresh;
    state = fresh;
    return status == Status::ok && !active_ ? Status::inactive : status;
  }

  /// Does at once what it is told.
  /// @return Status::hardware_fault if the script says so, Status::inactive if the hardware is not
  ///         active, Status::non_finite_command if the command is refused
  /// Real-time: yes. O(N + length of the script).
  [[nodiscard]] Status write(const Command& command) noexcept {
    ++writes_;
    if (now(MockFaultKind::fails_to_write)) return Status::hardware_fault;
    if (!active_) return Status::inactive;
    if (!is_finite(command)) return Status::non_finite_command;
    written_ = command;
    if constexpr (std::same_as<Command, PositionCommand<joint_count>>) {
      joints_.velocity = (command.position - joints_.position) / period_;
      joints_.position = command.position;
    } else if constexpr (std::same_as<Command, VelocityCommand<joint_count>>) {
      joints_.velocity = command.velocity;
      joints_.position += command.velocity * period_;
    } else {
      if constexpr (std::same_as<Command, MultiModeCommand<joint_count>>) follow(command);
      joints_.effort = command.effort;
    }
    return Status::ok;
  }

  /// Puts the joints somewhere else, as a hand would. Real-time: yes.
  void set_state(const JointState<joint_count>& state) noexcept { joints_ = state; }
  /// The last command that was accepted. Real-time: yes.
  [[nodiscard]] const Command& written() const noexcept { return written_; }
  /// How often `write` was called, in whatever mode. Real-time: yes.
  [[nodiscard]] std::uint64_t writes() const noexcept { return writes_; }
  /// How often `read` was called. Real-time: yes.
  [[nodiscard]] std::uint64_t readings() const noexcept { return readings_; }
  [[nodiscard]] bool active() const noexcept { return active_; }
  [[nodiscard]] double period() const noexcept { return period_; }
  [[nodiscard]] const R& robot() const noexcept { return robot_; }

 private:
  /// True if the script has that fault for the reading that was made last.
  [[nodiscard]] bool now(MockFaultKind kind) const noexcept {
    const std::uint64_t reading = readings_ == 0 ? 0 : readings_ - 1;
    for (const MockFault& fault : script_) {
      if (fault.kind == kind && fault.covers(reading)) return true;
    }
    return false;
  }
  void follow(const MultiModeCommand<joint_count>& command) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      double velocity = 0;
      if (command.stiffness[j] > 0) {
        velocity = (command.position[j] - joints_.position[j]) / period_;
        joints_.position[j] = command.position[j];
      } else if (command.damping[j] > 0) {
        velocity = command.velocity[j];
        joints_.position[j] += velocity * period_;
      }
      joints_.velocity[j] = velocity;
    }
  }

  static void spoil(JointVector<joint_count>& values, int joint, double value) noexcept {
    if (joint < 0) {
      values.setConstant(value);
    } else {
      values[joint] = value;
    }
  }

  [[no_unique_address]] R robot_;
  std::vector<MockFault> script_;
  double period_;
  bool active_ = false;
  std::uint64_t readings_ = 0;
  std::uint64_t writes_ = 0;
  JointState<joint_count> joints_{};
  JointState<joint_count> measured_{};
  Command written_{};
};

}  // namespace articula
