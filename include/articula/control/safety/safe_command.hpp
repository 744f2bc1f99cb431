// SPDX-License-Identifier: Apache-2.0
/// @file The safe command for a cycle with a fault.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/scalar.hpp"
#include "articula/dynamics/gravity.hpp"

#include <concepts>
#include <type_traits>

namespace articula {

/// A command with its effort within the limits of the robot's drives. Positions, velocities and
/// gains pass: the drives limit them, or Limited does. Real-time: yes.
template <Robot R, class Command>
  requires JointCommand<Command, joint_count<R>, typename detail::CommandScalar<Command>::Type>
[[nodiscard]] Command within_effort_limits(const R& robot, Command command) noexcept {
  if constexpr (requires { command.effort; }) {
    const JointVector<joint_count<R>> limits = effort_limits(robot);
    for (int j = 0; j < joint_count<R>; ++j) {
      command.effort[j] = clamp(command.effort[j], -limits[j], limits[j]);
    }
  }
  return command;
}

/// The command for a cycle in which something is wrong. Where the position is known, the command
/// holds it: by the gravity effort, the position itself, or zero velocity. Drives with a spring of
/// their own hold it by the last stiffness and damping, and the gravity effort. Where it is not,
/// efforts, velocities and stiffnesses are zero, and the last damping stays. There is no safe
/// position without a measured one, so the position command is `last` then. Each robot of a pack
/// gets the command that it would get alone.
/// @param robot     whose joints these are
/// @param position  measured position [rad or m], N x 1; not used unless finite
/// @param last      the last command that was written
/// @return          a finite command within the limits
/// Real-time: yes.
template <Robot R, class Command, class S = typename detail::CommandScalar<Command>::Type>
  requires JointCommand<Command, joint_count<R>, S>
[[nodiscard]] Command safe_command(
    const R& robot, const std::type_identity_t<JointVector<joint_count<R>, S>>& position,
    const Command& last) noexcept {
  constexpr int N = joint_count<R>;
  const auto known = is_finite(position);
  const auto where = [](const auto& mask, const auto& chosen, const auto& other) noexcept {
    return for_each_joint<N, S>([&](int j) noexcept { return select(mask, chosen[j], other[j]); });
  };
  const JointVector<N, S> zero = JointVector<N, S>::Zero();
  Command command;
  if constexpr (std::same_as<Command, PositionCommand<N, S>>) {
    command.position = where(known, position, last.position);
  } else if constexpr (requires { command.effort; }) {
    if constexpr (requires { command.stiffness; }) {
      command.damping = last.damping;
      command.position = where(known, position, zero);
      command.stiffness = where(known, last.stiffness, zero);
    }
    const JointVector<N, S> weight = gravity(robot, position);
    command.effort = where(known & is_finite(weight), weight, zero);
    command = within_effort_limits(robot, command);
  }
  return command;
}

}  // namespace articula
