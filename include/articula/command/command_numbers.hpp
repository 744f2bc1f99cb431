// SPDX-License-Identifier: Apache-2.0
/// @file The efforts, velocities or positions that a command makes.
#pragma once

#include "articula/command/drive_spring.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"

namespace articula {

/// The numbers that must not jump when one command follows another: efforts, velocities or
/// positions. For a MultiModeCommand it is the whole effort that it makes at the measured state. N
/// x 1.
/// Real-time: yes.
template <int N, class S, JointCommand<N, S> Command>
[[nodiscard]] JointVector<N, S> numbers_of(const Command& command,
                                           const JointState<N, S>& state) noexcept {
  if constexpr (requires { command.stiffness; }) {
    return spring_pull(command, state) + command.effort;
  } else {
    return values_of(command);
  }
}

}  // namespace articula
