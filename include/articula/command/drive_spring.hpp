// SPDX-License-Identifier: Apache-2.0
/// @file The effort of springs and dampers in drives.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_command.hpp"
#include "articula/core/joint_state.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The effort of springs and dampers at a measured state [N m or N], N x 1. It is K (q_ref - q) + D
/// (v_ref - v), without the commanded effort. Real-time: yes.
template <int N, class S>
[[nodiscard]] JointVector<N, S> spring_pull(const MultiModeCommand<N, S>& command,
                                            const JointState<N, S>& state) noexcept {
  return command.stiffness.cwiseProduct(command.position - state.position) +
         command.damping.cwiseProduct(command.velocity - state.velocity);
}

/// Changes one drive's command so that spring, damper and effort have a given total at the measured
/// state. It moves the references towards the state until they exert no more than total minus
/// effort. The rest is in the effort, which keeps its limit.
/// @param command  its stiffness and damping stay
/// @param state    measured, finite
/// @param joint    index of the drive
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

/// Limits the total of one drive's spring, damper and effort, and its effort, by set_total. A total
/// that is not finite stays. Parameters as those of set_total. Real-time: yes.
template <int N>
void limit_total(MultiModeCommand<N>& command, const JointState<N>& state, int joint,
                 double limit) noexcept {
  const double total = spring_pull(command, state)[joint] + command.effort[joint];
  const double most = std::max(std::abs(total), std::abs(command.effort[joint]));
  if (!is_finite(total) || most <= limit) return;
  set_total(command, state, joint, std::clamp(total, -limit, limit), limit);
}

}  // namespace articula
