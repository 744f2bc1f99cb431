// SPDX-License-Identifier: Apache-2.0
/// @file What a robot's hardware is, real or simulated.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/status.hpp"

#include <chrono>
#include <concepts>

namespace articula {

/// The joints of a robot, real or simulated, as a control loop sees them.
///
/// - `RobotType` is the robot whose joints these are; `robot()` returns it.
/// - `activate()` makes the drives ready to follow commands, `deactivate()` ends that. Both belong
///   to set-up and may take their time.
/// - `read(state)` fills in the measurements. It answers Status::stale_state if those of any joint
///   are older than the hardware allows, Status::hardware_fault if there are none to rely on. On
///   anything but Status::ok no controller sees the state.
/// - `write(command)` hands over the command for the coming period; it is held until the next one.
/// - Before `activate()` has succeeded, and after `deactivate()`, both answer Status::inactive, or
///   Status::hardware_fault. `read` may fill in measurements even then; no drive follows a command.
///   Hardware that needs no activation, as a simulator, is active until `deactivate()`.
///
/// `read` and `write` are noexcept and do nothing that could delay the loop but their own input and
/// output.
///
/// Hardware that dictates the period, as a simulator does, also has `period()` [s]; hardware whose
/// own cycle can pace the loop has `wait_for_cycle(timeout)`, see PacingHardware.
/// @tparam H        the hardware
/// @tparam Command  what it accepts
template <class H, class Command = EffortCommand<H::joint_count>>
concept Hardware = requires(H hardware, const H& constant, JointState<H::joint_count>& state,
                            const Command& command) {
  typename H::RobotType;
  { constant.robot() } -> std::convertible_to<const typename H::RobotType&>;
  { hardware.activate() } -> std::same_as<Status>;
  { hardware.deactivate() } -> std::same_as<Status>;
  { hardware.read(state) } noexcept -> std::same_as<Status>;
  { hardware.write(command) } noexcept -> std::same_as<Status>;
} && JointCommand<Command, H::joint_count>;

/// Hardware whose own cycle can pace the loop: `wait_for_cycle(timeout)` blocks until that cycle
/// begins, and answers with another status than Status::ok if it does not begin in time.
template <class H>
concept PacingHardware = requires(H hardware, std::chrono::nanoseconds timeout) {
  { hardware.wait_for_cycle(timeout) } noexcept -> std::same_as<Status>;
};

}  // namespace articula
