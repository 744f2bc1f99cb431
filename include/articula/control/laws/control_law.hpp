// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a law: one term of a controller's output.
#pragma once

#include "articula/core/control_input.hpp"
#include "articula/core/joint_vector.hpp"

#include <concepts>

namespace articula {

namespace detail {

template <class L, int N, class S = double>
concept StartsLaw = requires(L& law, const ControlInput<N, S>& input) {
  { law.start(input) } noexcept;
};

/// A law whose memory can begin with a command: `start` returns its share.
template <class L, int N, class S = double>
concept SharesApplied = requires(L& law, const ControlInput<N, S>& input) {
  { law.start(input) } noexcept -> std::convertible_to<JointVector<N, S>>;
};

}  // namespace detail

/// A law is one term of a controller's output, not yet limited. Write one to add a term to a
/// SumController, such as a compensation of your own:
///
///     struct SpringCompensation {
///       JointVector<2> output(const ControlInput<2>& in) const noexcept {
///         return 3.0 * in.state.position;
///       }
///     };
///
/// - `output(input)` is the term for the coming period, in the unit of the command [N m or N; rad/s
///   or m/s; rad or m]. `input.cut` is what limits took from the controller's last output: positive
///   above the upper limit, negative below the lower, 0 within. A law with an integral takes back
///   what would wind up.
/// - `start(input)`, if there is one, forgets the past. A law whose memory can begin with the
///   command in `input.applied` (what the terms before it have left of that) returns its share, N x
///   1. Any other returns void.
///
/// For a term that is a whole controller, see Controller.
/// @tparam L  the law
/// @tparam N  number of joints
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <class L, int N, class S = double>
concept ControlLaw = requires(L& law, const ControlInput<N, S>& input) {
  { law.output(input) } noexcept -> std::convertible_to<JointVector<N, S>>;
} && (detail::StartsLaw<L, N, S> || !requires { &L::start; });

}  // namespace articula
