// SPDX-License-Identifier: Apache-2.0
/// @file How a controller goes on after cycles in which it was not asked.
#pragma once

#include "articula/control/laws/effort_law.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"

namespace articula::detail {

/// Cycles in a row without an answer over which a controller's memory is kept.
inline constexpr int borne_cycles = 3;

/// Starts a controller anew that was not asked for more than `borne_cycles`, while the joints were
/// braked and held. It goes on from the command that held them, if it can.
/// @param given  that command, N x 1, see numbers_of
/// Real-time: yes.
template <class C, int N>
void resume(C& controller, const JointState<N>& state, const JointReference<N>& reference,
            double period, const JointVector<N>& given) noexcept {
  controller.start(state);
  if constexpr (TakesGiven<C, N>) controller.given(given);
  if constexpr (Primable<C, N>) {
    static_cast<void>(prime(controller, state, reference, period, given, LastCommand::load));
  }
}

}  // namespace articula::detail
