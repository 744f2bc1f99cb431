// SPDX-License-Identifier: Apache-2.0
/// @file The law that passes on one member of the reference.
#pragma once

#include "articula/core/control_input.hpp"

namespace articula {

/// Passes on one member of the reference: alone it is open-loop control, in a sum it is
/// feed-forward.
/// @tparam N       number of joints
/// @tparam Member  which one, in the unit of the command
/// @tparam S       type of a number: double, or a pack with the numbers of several robots
template <int N, auto Member, class S = double>
struct Feedforward {
  static constexpr bool follows_position = Member == &JointReference<N, S>::position;

  /// The reference's member, N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N, S> output(const ControlInput<N, S>& in) const noexcept {
    return in.reference.*Member;
  }
};

/// The effort that the reference asks for.
template <int N, class S = double>
using EffortFeedforward = Feedforward<N, &JointReference<N, S>::effort, S>;

/// The velocity that the reference asks for, in a controller of velocity drives.
template <int N, class S = double>
using VelocityFeedforward = Feedforward<N, &JointReference<N, S>::velocity, S>;

/// The position that the reference asks for, in a controller of position drives.
template <int N, class S = double>
using PositionFeedforward = Feedforward<N, &JointReference<N, S>::position, S>;

}  // namespace articula
