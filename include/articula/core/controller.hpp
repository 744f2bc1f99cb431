// SPDX-License-Identifier: Apache-2.0
/// @file What a controller is.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"

namespace articula {

/// A controller for N joints: turns state and reference into a command, once per period.
///
/// - `start(state)` is called before the first `update` and whenever control begins anew; it
///   forgets the past, so that the next command does not depend on it.
/// - `update(state, reference, period)` computes the command for the coming period [s].
///
/// Both are noexcept and must not allocate, lock or call the system: they run in the control loop.
/// @tparam C  the controller
/// @tparam N  number of joints
template <class C, int N>
concept Controller = requires(C controller, const JointState<N>& state,
                              const JointReference<N>& reference, double period) {
  { controller.start(state) } noexcept;
  { controller.update(state, reference, period) } noexcept -> JointCommand<N>;
};

}  // namespace articula
