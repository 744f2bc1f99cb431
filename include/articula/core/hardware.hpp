// SPDX-License-Identifier: Apache-2.0
/// @file The concept of hardware, to connect drives and sensors of your own to a loop.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/scalar.hpp"
#include "articula/core/status.hpp"

#include <chrono>
#include <concepts>

namespace articula {

/// The drives and sensors of a robot, real or simulated. Write one to connect drives that the
/// library does not know to a Loop:
///
///     class MyArm {
///      public:
///       using RobotType = Q2d;
///       static constexpr int joint_count = articula::joint_count<Q2d>;
///       const Q2d& robot() const { return robot_; }
///       Status activate();     // switches the drives on
///       Status deactivate();
///       Status read(JointState<2>& state) noexcept;
///       Status write(const EffortCommand<2>& command) noexcept;
///     };
///
/// Do not write one for drives on a CAN bus: write a CanCodec, and CanHardware does the rest. To
/// test a program without drives, use MockHardware or Simulator.
///
/// - `RobotType` is the type of the robot; `robot()` returns it.
/// - `activate()` makes the drives ready to follow commands, `deactivate()` ends that. Both belong
///   to set-up and may block.
/// - `read(state)` fills in the measurements. It returns Status::stale_state if a joint's
///   measurement is too old, Status::hardware_fault if there is no valid one. Controllers get the
///   state only after Status::ok.
/// - `write(command)` sends the command for the coming period. Drives hold it until the next one.
/// - Before `activate()` has succeeded, and after `deactivate()`, both return Status::inactive or
///   Status::hardware_fault. `read` may still fill in measurements; no drive follows a command.
///   Hardware that needs no activation, such as a simulator, is active until `deactivate()`.
///
/// `read` and `write` are noexcept. Only their own input and output may delay the loop.
///
/// Hardware with a period of its own, such as a simulator, also has `period()` [s]. Hardware with a
/// cycle that can pace the loop has `wait_for_cycle(timeout)`: see PacingHardware. A simulator of
/// several robots has a type `Scalar`: a pack with the numbers of all robots.
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

/// Hardware whose own cycle can pace the loop, such as a bus with a synchronisation frame.
/// `wait_for_cycle(timeout)` blocks until that cycle begins. It returns another status than
/// Status::ok if the cycle does not begin in time.
template <class H>
concept PacingHardware = requires(H hardware, std::chrono::nanoseconds timeout) {
  { hardware.wait_for_cycle(timeout) } noexcept -> std::same_as<Status>;
};

}  // namespace articula
