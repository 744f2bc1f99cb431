// SPDX-License-Identifier: Apache-2.0
/// @file The input of a controller in one cycle.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/core/joint_vector.hpp"
#include "articula/core/scalar.hpp"

namespace articula {

/// What the command that was applied last has done. In the order of what can be built on it.
enum class Held : unsigned char {
  nothing,  ///< There is no such command: at a cold start, or in calls without a loop.
  unsure,   ///< It was sent, but joints or drives were lost. Rates go on from it, integrals do not.
  push,     ///< It reached the drives. It may have been a passing push.
  load,     ///< It held the joints.
};

/// The command that was applied last.
/// @tparam N       number of joints
/// @tparam Scalar  as that of JointVector
template <int N, class Scalar = double>
struct Applied {
  /// numbers_of that command, N x 1
  JointVector<N, Scalar> numbers = JointVector<N, Scalar>::Zero();
  Held held = Held::nothing;

  /// Whether the drives got the command, so that an integral can begin with it. Real-time: yes.
  [[nodiscard]] constexpr bool reached_drives() const noexcept { return held >= Held::push; }
};

/// The input of a controller, or of one of its laws, in one cycle. It refers to state and
/// reference, and lives as long as the call to which it is passed:
///
///     controller.update({state, reference, period});
///
/// `applied` and `cut` belong to the last cycle in which this controller was called. They close the
/// loop around limits: an integral takes back what was cut, and a switch goes on from what was
/// applied. A composition passes `applied` inward unchanged, and as `cut` its own clip plus the cut
/// that came from outside.
/// @tparam N       number of joints
/// @tparam Scalar  type of a number: double, or a pack with the numbers of several robots
template <int N, class Scalar = double>
struct ControlInput {
  static constexpr int joint_count = N;

  const JointState<N, Scalar>& state;          ///< as measured in this cycle, finite
  const JointReference<N, Scalar>& reference;  ///< what the joints are asked to do, finite
  double period;                               ///< dt, time until the next cycle, > 0 [s]
  Applied<N, Scalar> applied{};                ///< of the whole robot
  /// The callee's own last command minus what was left of it, in the unit of the command, N x 1.
  /// Exactly 0 where nothing was cut off, after a start, and after a failed command.
  JointVector<N, Scalar> cut = JointVector<N, Scalar>::Zero();
};

/// Calls function(lane, input) with the ControlInput<N> of the robot in each lane. Use it where a
/// controller consists of decisions, which differ by lane, so that `select` does not serve. For
/// double the function gets the input itself, with lane 0.
/// @param in        of all robots
/// @param function  callable with (int, const ControlInput<N>&)
/// Real-time: yes, if the function is.
template <int N, class S>
void for_each_lane(const ControlInput<N, S>& in, auto&& function) noexcept {
  if constexpr (PackedScalar<S>) {
    for (int k = 0; k < lanes<S>; ++k) {
      const JointState<N> state = lane_of(in.state, k);
      const JointReference<N> reference = lane_of(in.reference, k);
      const Applied<N> applied{lane_of(in.applied.numbers, k), in.applied.held};
      function(k, ControlInput<N>{state, reference, in.period, applied, lane_of(in.cut, k)});
    }
  } else {
    function(0, in);
  }
}

}  // namespace articula
