// SPDX-License-Identifier: Apache-2.0
/// @file What the reference asks for, passed on.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"

namespace articula {

/// Passes on one member of the reference: alone it is open-loop control, in a sum it is
/// feed-forward.
/// @tparam N       number of joints
/// @tparam Member  which one, in the unit of the command
template <int N, JointVector<N> JointReference<N>::* Member>
class Feedforward {
 public:
  /// Nothing to forget. Real-time: yes.
  void start(const JointState<N>&) noexcept {}

  /// The reference's member, N x 1. Real-time: yes.
  [[nodiscard]] JointVector<N> effort(const JointState<N>&, const JointReference<N>& reference,
                                      double) const noexcept {
    return reference.*Member;
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
