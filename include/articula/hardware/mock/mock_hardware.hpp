// SPDX-License-Identifier: Apache-2.0
/// @file Mock hardware: joints that follow every command at once, and fail by a script.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/hardware.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace articula {

/// The kind of a fault of mock hardware.
enum class MockFaultKind : unsigned char {
  refuses_activation,  ///< activate() returns Status::hardware_fault.
  fails_to_read,       ///< read() returns Status::hardware_fault and keeps the state.
  fails_to_write,      ///< write() returns Status::hardware_fault, and the joints stay.
  goes_silent,         ///< read() returns Status::stale_state with the joint's last figures.
  measures_nan,        ///< The joint's measured position is NaN.
  measures_position,   ///< The joint's measured position is `value`.
  measures_velocity,   ///< The joint's measured velocity is `value`.
};

/// A fault of mock hardware at some readings. Readings count from 0; a Loop makes the first in its
/// constructor. A write belongs to the reading before it.
struct MockFault {
  MockFaultKind kind{};
  std::uint64_t first = 0;                                          ///< reading of its begin
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();  ///< number of readings
  int joint = -1;    ///< index of the joint; -1: all joints
  double value = 0;  ///< measured instead [rad or m, rad/s or m/s]

  /// Real-time: yes.
  [[nodiscard]] constexpr bool covers(std::uint64_t reading) const noexcept {
    return reading >= first && reading - first < count;
  }
};

/// Checks a script and the period.
/// @param script       the faults
/// @param joint_count  of the robot
/// @param period       of the hardware [s]
/// @throws std::invalid_argument with the fault, the value and the limit
/// Real-time: no (throws).
inline void validate(const std::vector<MockFault>& script, int joint_count, double period) {
  if (!is_finite(period) || period <= 0) {
    detail::refuse({"mock hardware: period ", period, " s is not a positive number"});
  }
  for (std::size_t i = 0; i < script.size(); ++i) {
    if (script[i].joint < -1 || script[i].joint >= joint_count) {
      detail::refuse({"mock hardware: fault ", i, ": joint ", script[i].joint,
                      " is not between -1 and ", joint_count - 1});
    }
  }
}

namespace detail {

/// The default command of a mock: positions for a robot without masses, else efforts.
template <Robot R>
using MockCommand = std::conditional_t<is_kinematic<R>, PositionCommand<joint_count<R>>,
                                       EffortCommand<joint_count<R>>>;

}  // namespace detail

/// Joints that follow every command at once, without dynamics, and fail by a script. For tests of a
/// program around a robot: its modes, errors and recordings. For control quality use a Simulator.
///
///     MockHardware<MyArm> arm({{.kind = MockFaultKind::goes_silent, .first = 100, .count = 5}});
///
/// | command | joints |
/// |---|---|
/// | position | stand there; velocity is the step over the period |
/// | velocity | move by one period |
/// | effort | report it as measured effort |
/// | spring and damper | with a spring as by a position, with a damper alone as by a velocity |
///
/// Commands act while the hardware is active. A command that is not finite is refused.
/// @tparam R            the robot
/// @tparam CommandType  command of the drives; by default efforts, for a kinematic robot positions
template <Robot R, JointCommand<joint_count<R>> CommandType = detail::MockCommand<R>>
class MockHardware {
 public:
  using RobotType = R;
  using Command = CommandType;
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot   whose joints these are
  /// @param script  its faults
  /// @param period  time from one command to the next [s]
  /// @throws std::invalid_argument as validate(script, joint_count, period)
  explicit MockHardware(const R& robot, std::vector<MockFault> script = {}, double period = 1e-3)
      : robot_(robot), script_(std::move(script)), period_(period) {
    validate(script_, joint_count, period_);
  }
  /// For a robot known at compile time.
  explicit MockHardware(std::vector<MockFault> script = {}, double period = 1e-3)
    requires DescribedRobot<R>
      : MockHardware(R(), std::move(script), period) {}

  /// Status::hardware_fault by the script, else Status::ok. Real-time: yes.
  [[nodiscard]] Status activate() noexcept {
    active_ = !fails(MockFaultKind::refuses_activation);
    return active_ ? Status::ok : Status::hardware_fault;
  }
  /// Real-time: yes.
  [[nodiscard]] Status deactivate() noexcept {
    active_ = false;
    return Status::ok;
  }

  /// Measures, with the script's faults of this reading. Inactive hardware returns
  /// Status::inactive. Real-time: yes. O(N + length of the script).
  [[nodiscard]] Status read(JointState<joint_count>& state) noexcept {
    const std::uint64_t reading = readings_++;
    Status status = Status::ok;
    JointState<joint_count> fresh = joints_;
    for (const MockFault& fault : script_) {
      if (!fault.covers(reading)) continue;
      if (fault.kind == MockFaultKind::fails_to_read) return Status::hardware_fault;
      if (fault.kind == MockFaultKind::goes_silent) status = Status::stale_state;
      for (int j = 0; j < joint_count; ++j) {
        if (fault.joint < 0 || fault.joint == j) distort(fault, j, fresh);
      }
    }
    measured_ = fresh;
    state = fresh;
    return status == Status::ok && !active_ ? Status::inactive : status;
  }

  /// Follows a command at once.
  /// @return Status::ok, Status::hardware_fault by the script, Status::inactive, or
  ///         Status::non_finite_command
  /// Real-time: yes. O(N + length of the script).
  [[nodiscard]] Status write(const Command& command) noexcept {
    ++writes_;
    if (fails(MockFaultKind::fails_to_write)) return Status::hardware_fault;
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

  /// Moves the joints to another state, as a hand would. Real-time: yes.
  void set_state(const JointState<joint_count>& state) noexcept { joints_ = state; }
  /// The last command that was accepted. Real-time: yes.
  [[nodiscard]] const Command& written() const noexcept { return written_; }
  /// Number of calls of `write`, in any mode. Real-time: yes.
  [[nodiscard]] std::uint64_t writes() const noexcept { return writes_; }
  /// Number of calls of `read`. Real-time: yes.
  [[nodiscard]] std::uint64_t readings() const noexcept { return readings_; }
  [[nodiscard]] bool active() const noexcept { return active_; }
  [[nodiscard]] double period() const noexcept { return period_; }
  [[nodiscard]] const R& robot() const noexcept { return robot_; }

 private:
  /// Whether the script has a fault for the last reading.
  [[nodiscard]] bool fails(MockFaultKind kind) const noexcept {
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

  /// Changes the measured figures of joint j.
  void distort(const MockFault& fault, int j, JointState<joint_count>& fresh) const noexcept {
    if (fault.kind == MockFaultKind::goes_silent) {
      fresh.position[j] = measured_.position[j];
      fresh.velocity[j] = measured_.velocity[j];
      fresh.effort[j] = measured_.effort[j];
    }
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    if (fault.kind == MockFaultKind::measures_nan) fresh.position[j] = not_a_number;
    if (fault.kind == MockFaultKind::measures_position) fresh.position[j] = fault.value;
    if (fault.kind == MockFaultKind::measures_velocity) fresh.velocity[j] = fault.value;
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
