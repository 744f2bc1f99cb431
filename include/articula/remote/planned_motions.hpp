// SPDX-License-Identifier: Apache-2.0
/// @file The reference of joints at a time to come.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/motion/joint_motion.hpp"
#include "articula/reference/trajectory/trajectory_bridge.hpp"
#include "articula/remote/engine/remote_record.hpp"
#include "articula/remote/in_flight.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace articula::remote {

/// The motion of each joint's reference at a time to come, as Port::planned describes it.
/// @param in_flight  has the trajectories that are followed
/// @param condition  the present one
/// @param present    the last reference
/// @param is_own     nobody else sets the reference
/// @param time       of the loop [s], not before the present
/// Real-time: no (allocates).
template <Robot R, class Command, int N = joint_count<R>>
[[nodiscard]] std::vector<std::optional<JointMotion>> planned_motions(
    InFlight<R, Command>& in_flight, const LoopCondition<N>& condition,
    const JointReference<N>& present, bool is_own, double time) {
  std::vector<std::optional<JointMotion>> motions(static_cast<std::size_t>(N));
  const auto motion = [&](int j) -> auto& { return motions[static_cast<std::size_t>(j)]; };
  for (int j = 0; j < N; ++j) {
    // The program of a plain loop may move a reference that rests for its Remote.
    const bool rests = is_own || (present.velocity[j] == 0 && present.acceleration[j] == 0);
    if (rests && condition.motions[j] == MotionKind::rest) {
      motion(j) = JointMotion{.position = present.position[j]};
    }
  }
  in_flight.for_each_followed(
      [&](const auto& trajectory, const auto& bridge, const TrajectoryClock& clock) {
        const SpeedOverride then = clock.at(time);
        const JointReference<N> reference = then.apply(sample(trajectory, bridge, then.time()));
        for (int j = 0; j < N; ++j) {
          if (trajectory.left_out()[j] || condition.motions[j] != MotionKind::trajectory) continue;
          motion(j) = motion_of(reference, j);
        }
      });
  return motions;
}

}  // namespace articula::remote
