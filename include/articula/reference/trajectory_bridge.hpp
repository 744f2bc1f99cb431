// SPDX-License-Identifier: Apache-2.0
/// @file The way from what is asked for at present into a trajectory.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/reference/motion_limits.hpp"
#include "articula/reference/trajectory.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

namespace articula {

/// The way from what is asked for at present to a point of a trajectory, and on. It replaces the
/// points before that one.
/// @tparam N  number of joints
template <int N>
struct TrajectoryBridge {
  TrajectoryPoint<N> from{};                      ///< the present, in the trajectory's time
  TrajectoryPoint<N> to{};                        ///< the point that it leads to, shifted
  std::size_t index = 0;                          ///< of that point
  JointVector<N> shift = JointVector<N>::Zero();  ///< whole turns of continuous joints [rad], N x 1

  /// The reference on the bridge, and on the trajectory after it.
  /// @param time  of the trajectory [s], within its duration
  /// Real-time: yes.
  template <Robot R, int Capacity>
  [[nodiscard]] JointReference<N> sample(const Trajectory<R, Capacity>& trajectory,
                                         double time) const noexcept {
    const std::size_t next = trajectory.next_point(time);
    if (next <= index) {
      if (trajectory.interpolation() == Interpolation::splines) {
        return interpolate(from, to, time - from.time_from_start);
      }
      return {from.position, JointVector<N>::Zero(), JointVector<N>::Zero(), from.effort};
    }
    const auto points = trajectory.points();
    if (next == points.size()) return trajectory.sample(time);
    JointReference<N> reference = trajectory.between(points[next - 1], points[next], time);
    reference.position += shift;
    return reference;
  }
};

/// Finds the way into a trajectory. From rest it is what interpolate() makes of a point at rest and
/// the trajectory's first point ahead. From motion it is the quintic that ends with the velocity
/// and acceleration that the trajectory has from that point on, whatever the points themselves
/// leave open. A point that it takes more than the velocity limit on average to reach, or from
/// motion more than the limits of velocity and acceleration (unless start or end are above them
/// already), is too close and left out, like the points in the past.
/// @param present     what is asked for, in the trajectory's time
/// @param trajectory  the trajectory
/// @param time        the present in the trajectory's time [s]
/// @param limits      V and A are used
/// @param turn        by how much a joint may be shifted to take the short way: 2 pi or 0 [rad],
///                    N x 1
/// @return            nothing if no point can be reached
/// Real-time: yes. O(N Capacity).
template <Robot R, int Capacity, int N = joint_count<R>>
[[nodiscard]] std::optional<TrajectoryBridge<N>> find_bridge(
    const JointReference<N>& present, const Trajectory<R, Capacity>& trajectory, double time,
    const MotionLimits<N>& limits, const JointVector<N>& turn) noexcept {
  const auto points = trajectory.points();
  const bool splines = trajectory.interpolation() == Interpolation::splines;
  const bool moves = !present.velocity.isZero(0) || !present.acceleration.isZero(0);
  for (std::size_t k = trajectory.next_point(time); k < points.size(); ++k) {
    TrajectoryBridge<N> bridge{
        {time, present.position, present.velocity, present.acceleration, present.effort},
        points[k],
        k};
    for (int j = 0; j < N; ++j) {
      if (turn[j] == 0) continue;
      const double apart = present.position[j] - points[k].position[j];
      bridge.shift[j] = turn[j] * std::round(apart / turn[j]);
    }
    bridge.to.position += bridge.shift;
    if (!splines) return bridge;

    const double period = points[k].time_from_start - time;
    const JointVector<N> distance = (bridge.to.position - present.position).cwiseAbs();
    const double enough = period * (1 + 1e-9);  // rounding
    if (((distance - enough * limits.velocity).array() > 0).any()) continue;
    if (!moves) return bridge;

    const JointReference<N> onward =
        k + 1 < points.size()
            ? trajectory.between(points[k], points[k + 1], points[k].time_from_start)
            : at_point(points[k]);
    bridge.to.velocity = onward.velocity;
    bridge.to.acceleration = onward.acceleration;
    const auto highest = [](const JointVector<N>& a, const JointVector<N>& b,
                            const JointVector<N>& limit) {
      return JointVector<N>(a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(limit));
    };
    const JointVector<N> v = highest(present.velocity, onward.velocity, limits.velocity);
    const JointVector<N> a =
        highest(present.acceleration, onward.acceleration, limits.acceleration);
    bool moderate = true;
    constexpr int samples = 16;  // a quintic's velocity has three extrema at most
    for (int i = 1; i < samples && moderate; ++i) {
      const auto r = interpolate(bridge.from, bridge.to, period * i / samples);
      moderate = !((r.velocity.cwiseAbs() - v).array() > 0).any() &&
                 !((r.acceleration.cwiseAbs() - a).array() > 0).any();
    }
    if (moderate) return bridge;
  }
  return std::nullopt;
}

}  // namespace articula
