// SPDX-License-Identifier: Apache-2.0
/// @file The safe command for a cycle with a fault.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/dynamics/gravity.hpp"

#include <algorithm>
#include <concepts>

namespace articula {

/// A command with its effort within the limits of the robot's drives. Positions, velocities and
/// gains pass: the drives limit them, or Limited does. Real-time: yes.
template <Robot R, JointCommand<joint_count<R>> Command>
[[nodiscard]] Command within_effort_limits(const R& robot, Command command) noexcept {
  if constexpr (requires { command.effort; }) {
    const JointVector<joint_count<R>> limits = effort_limits(robot);
    for (int j = 0; j < joint_count<R>; ++j) {
      command.effort[j] = std::clamp(command.effort[j], -limits[j], limits[j]);
    }
  }
  return command;
}

/// The command for a cycle in which something is wrong. Where the position is known, it holds: by
/// the gravity effort, the position itself, or zero velocity; drives with a spring of their own
/// hold it by the last stiffness and damping, and the gravity effort. Where it is not, efforts,
/// velocities and stiffnesses are zero, and the last damping stays. There is no safe position
/// without a measured one, so the position command is `last` then.
/// @param robot     whose joints these are
/// @param position  measured position [rad or m], N x 1; not used unless finite
/// @param last      the last command that was written
/// @return          a finite command within the limits
/// Real-time: yes.
template <Robot R, JointCommand<joint_count<R>> Command>
[[nodiscard]] Command safe_command(const R& robot, const JointVector<joint_count<R>>& position,
                                   const Command& last) noexcept {
  Command command;
  if constexpr (std::same_as<Command, PositionCommand<joint_count<R>>>) {
    command.position = is_finite(position) ? position : last.position;
  } else if constexpr (requires { command.effort; }) {
    if constexpr (std::same_as<Command, MultiModeCommand<joint_count<R>>>) {
      command.damping = last.damping;
      if (is_finite(position)) {
        command.position = position;
        command.stiffness = last.stiffness;
      }
    }
    if (is_finite(position)) command.effort = gravity(robot, position);
    if (!is_finite(command.effort)) command.effort.setZero();
    command = within_effort_limits(robot, command);
  }
  return command;
}

}  // namespace articula
