// SPDX-License-Identifier: Apache-2.0
/// @file What a part of a controller is.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/joint_vector.hpp"

#include <concepts>

namespace articula {

/// A part of a controller: one summand of the total effort, not yet limited. In a controller of
/// velocity or position drives the same part is a summand of the velocity or position.
///
/// - `start(state)` forgets the past.
/// - `effort(state, reference, period)` is the part's share for the coming period, in the unit of
///   the command [N m or N; rad/s or m/s; rad or m].
/// @tparam L  the part
/// @tparam N  number of joints
template <class L, int N>
concept EffortLaw =
    requires(L law, const JointState<N>& state, const JointReference<N>& reference, double period) {
      { law.start(state) } noexcept;
      { law.effort(state, reference, period) } noexcept -> std::convertible_to<JointVector<N>>;
    };

/// What must know when its command is cut off: after `effort` (or a controller's `update`),
/// `limited(excess)` tells by how much the total exceeded the limits (positive above the upper
/// limit, negative below the lower, 0 within) in the unit of the command, so that it can take back
/// what would only wind up. It may be told more than once in a cycle, of one limit after the other.
template <class L, int N>
concept LimitAware = requires(L law, const JointVector<N>& excess) {
  { law.limited(excess) } noexcept;
};

/// What goes on from the command that was given in the end: after `update`, `given(command)` tells
/// the numbers of that command, N x 1 (see numbers_of), whatever became of the controller's own.
template <class L, int N>
concept TakesGiven = requires(L law, const JointVector<N>& command) {
  { law.given(command) } noexcept;
};

/// What can take over from another controller without a jump: after `start` and before the first
/// `effort` (or a controller's `update`), `prime(state, reference, period, effort)` tells which
/// effort (or command) was given last, so that what the part remembers can begin there: an integral
/// takes it for the load that it has to carry. The part answers with its share of that effort, N x
/// 1.
template <class L, int N>
concept Primable = requires(L law, const JointState<N>& state, const JointReference<N>& reference,
                            double period, const JointVector<N>& effort) {
  { law.prime(state, reference, period, effort) } noexcept -> std::convertible_to<JointVector<N>>;
};

/// What is known of the command that a Primable part begins with. A part that minds takes it as a
/// last argument of `prime`; where there is none it is `any`.
enum class LastCommand {
  any,   ///< It may have been a passing push of another controller.
  load,  ///< It has held the joints.
};

namespace detail {

/// Primes a part, and tells it what the command is if it minds. Real-time: yes.
template <class Law, int N>
JointVector<N> prime(Law& law, const JointState<N>& state, const JointReference<N>& reference,
                     double period, const JointVector<N>& command, LastCommand is) noexcept {
  if constexpr (requires { law.prime(state, reference, period, command, is); }) {
    return law.prime(state, reference, period, command, is);
  } else {
    return law.prime(state, reference, period, command);
  }
}

}  // namespace detail

/// What can go on with other gains of the kind `Gains` between two cycles.
template <class L, class Gains>
concept TakesGains = requires(L law, const Gains& gains) {
  { law.set_gains(gains) } noexcept;
};

}  // namespace articula
