// SPDX-License-Identifier: Apache-2.0
/// @file The interface of a robot's hardware, real or simulated.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/scalar.hpp"
#include "articula/core/status.hpp"

#include <chrono>
#include <concepts>

namespace articula {

/// The sensors and drives of a robot, real or simulated. Implement it to connect drives that the
/// library does not know to a Loop. To test a program without drives, use MockHardware or
/// Simulator.
///
/// - `RobotType` is the type of the robot; `robot()` returns it.
/// - `activate()` makes the drives ready to follow commands, `deactivate()` ends that. Both belong
///   to set-up and may block.
/// - `read(state)` fills in the measurements. It returns Status::stale_state if those of any joint
///   are older than the hardware allows, Status::hardware_fault if there are no valid ones.
///   Controllers get the state only after Status::ok.
/// - `write(command)` sends the command for the coming period. Drives hold it until the next one.
/// - Before `activate()` has succeeded, and after `deactivate()`, both return Status::inactive or
///   Status::hardware_fault. `read` may still fill in measurements; no drive follows a command.
///   Hardware that needs no activation, such as a simulator, is active until `deactivate()`.
///
/// `read` and `write` are noexcept. Only their own input and output may delay the loop.
///
/// A simulator of several robots at once has a type `Scalar` of a pack of their numbers. Hardware
/// with a period of its own, such as a simulator, also has `period()` [s]. Hardware with a
/// cycle that can pace the loop has `wait_for_cycle(timeout)`, see PacingHardware.
/// @tparam H        the hardware
/// @tparam Command  the commands that it accepts
template <class H, class Command = EffortCommand<H::joint_count, ScalarOf<H>>>
concept Hardware = requires(H hardware, const H& constant,
                            JointState<H::joint_count, ScalarOf<H>>& state,
                            const Command& command) {
  typename H::RobotType;
  { constant.robot() } -> std::convertible_to<const typename H::RobotType&>;
  { hardware.activate() } -> std::same_as<Status>;
  { hardware.deactivate() } -> std::same_as<Status>;
  { hardware.read(state) } noexcept -> std::same_as<Status>;
  { hardware.write(command) } noexcept -> std::same_as<Status>;
} && JointCommand<Command, H::joint_count, ScalarOf<H>>;

/// Hardware whose own cycle can pace the loop: `wait_for_cycle(timeout)` blocks until that cycle
/// begins, and returns another status than Status::ok if it does not begin in time.
template <class H>
concept PacingHardware = requires(H hardware, std::chrono::nanoseconds timeout) {
  { hardware.wait_for_cycle(timeout) } noexcept -> std::same_as<Status>;
};

}  // namespace articula
