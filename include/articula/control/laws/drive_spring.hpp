// SPDX-License-Identifier: Apache-2.0
/// @file The total of springs and dampers in drives.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"

#include <algorithm>

namespace articula {

/// What the springs and dampers of drives pull at a measured state: K (q_ref - q) + D (v_ref - v),
/// without the effort [N m or N], N x 1. Real-time: yes.
template <int N>
[[nodiscard]] JointVector<N> spring_pull(const MultiModeCommand<N>& command,
                                         const JointState<N>& state) noexcept {
  return command.stiffness.cwiseProduct(command.position - state.position) +
         command.damping.cwiseProduct(command.velocity - state.velocity);
}

/// Changes what one drive is asked for so that spring, damper and effort make a given total at the
/// measured state. The references are drawn towards the state until they pull no more than is left
/// for them beside the effort; the rest is in the effort, which thereby keeps its limit.
/// @param command  its stiffness and damping stay
/// @param state    what is measured, finite
/// @param joint    which drive
/// @param total    [N m or N], within the limit
/// @param limit    of total and effort, >= 0 [N m or N]
/// Real-time: yes.
template <int N>
void set_total(MultiModeCommand<N>& command, const JointState<N>& state, int joint, double total,
               double limit) noexcept {
  const int j = joint;
  const double pull = spring_pull(command, state)[j];
  const double left = total - std::clamp(command.effort[j], -limit, limit);
  const double share = pull != 0 ? std::clamp(left / pull, 0.0, 1.0) : 1;
  command.position[j] = state.position[j] + share * (command.position[j] - state.position[j]);
  command.velocity[j] = state.velocity[j] + share * (command.velocity[j] - state.velocity[j]);
  command.effort[j] = total - share * pull;
}

}  // namespace articula
