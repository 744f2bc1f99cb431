// SPDX-License-Identifier: Apache-2.0
/// @file The law that passes on one member of the reference.
#pragma once

#include "articula/core/control_input.hpp"

namespace articula {

/// Passes on one member of the reference: alone it is open-loop control, in a sum it is
/// feed-forward.
/// @tparam N       number of joints
/// @tparam Member  which one, in the unit of the command
template <int N, JointVector<N> JointReference<N>::* Member>
struct Feedforward {
  /// The reference's member, N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N> output(const ControlInput<N>& in) const noexcept {
    return in.reference.*Member;
  }
};

/// The effort that the reference asks for.
template <int N>
using EffortFeedforward = Feedforward<N, &JointReference<N>::effort>;

/// The velocity that the reference asks for, in a controller of velocity drives.
template <int N>
using VelocityFeedforward = Feedforward<N, &JointReference<N>::velocity>;

/// The position that the reference asks for, in a controller of position drives.
template <int N>
using PositionFeedforward = Feedforward<N, &JointReference<N>::position>;

}  // namespace articula
