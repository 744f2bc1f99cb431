// SPDX-License-Identifier: Apache-2.0
/// @file The way from what is asked for at present into a trajectory.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/reference/trajectory/trajectory.hpp"
#include "articula/reference/trajectory/trajectory_refusal.hpp"
#include "articula/reference/trajectory/way_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

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
};

/// Where N joints can be.
/// @tparam N  number of joints
template <int N>
struct JointRange {
  JointVector<N> lower, upper;  ///< limits of the position [rad or m], N x 1
  JointVector<N> turn;          ///< how far on it is the same: 2 pi, or 0 for nowhere [rad], N x 1
};

/// Finds the way into a trajectory. From rest it is what interpolate() makes of a point at rest and
/// the trajectory's first point ahead. From motion it is the quintic that ends with the velocity
/// and acceleration that the trajectory has from that point on, whatever the points themselves
/// leave open. A point that it takes more than the velocity limit on average to reach, or anywhere
/// on the way more than the limits of position, velocity and acceleration (unless start or end are
/// beyond them already), is too close and left out, like the points in the past.
/// @param present     what is asked for, in the trajectory's time
/// @param trajectory  the trajectory
/// @param time        the present in the trajectory's time [s]
/// @param limits      V and A are used
/// @param range       where the joints can be; those that turn take the short way
/// @param refusal     receives why the last point cannot be reached, if none can
/// @return            nothing if no point can be reached
/// Real-time: yes. O(N Capacity).
template <Robot R, int Capacity, int N = joint_count<R>>
[[nodiscard]] std::optional<TrajectoryBridge<N>> find_bridge(
    const JointReference<N>& present, const Trajectory<R, Capacity>& trajectory, double time,
    const MotionLimits<N>& limits, const JointRange<N>& range,
    TrajectoryRefusal& refusal) noexcept {
  const auto within = [&](std::string_view what, const JointVector<N>& values,
                          const JointVector<N>& limit, double side = 1) {
    for (int j = 0; j < N; ++j) {
      if (!(side * (values[j] - limit[j]) > 1e-9 * std::abs(limit[j]))) continue;  // rounding
      const auto rule = side > 0 ? "is above its limit" : "is below its limit";
      refusal = {what, values[j], j, rule, limit[j]};
      return false;
    }
    return true;
  };
  const auto points = trajectory.points();
  const bool splines = trajectory.interpolation() == Interpolation::splines;
  const bool moves = !present.velocity.isZero(0) || !present.acceleration.isZero(0);
  for (std::size_t k = trajectory.next_point(time); k < points.size(); ++k) {
    TrajectoryBridge<N> bridge{
        {time, present.position, present.velocity, present.acceleration, present.effort},
        points[k],
        k};
    for (int j = 0; j < N; ++j) {
      if (range.turn[j] == 0) continue;
      const double apart = present.position[j] - points[k].position[j];
      bridge.shift[j] = range.turn[j] * std::round(apart / range.turn[j]);
    }
    bridge.to.position += bridge.shift;
    if (!splines) return bridge;

    const double period = points[k].time_from_start - time;
    const JointVector<N> distance = (bridge.to.position - present.position).cwiseAbs();
    if (!within("on the way to the last point the mean velocity", distance / period,
                limits.velocity)) {
      continue;
    }

    if (moves) {
      const JointReference<N> onward =
          k + 1 < points.size()
              ? trajectory.between(points[k], points[k + 1], points[k].time_from_start)
              : at_point(points[k]);
      bridge.to.velocity = onward.velocity;
      bridge.to.acceleration = onward.acceleration;
    }
    const auto highest = [](const JointVector<N>& a, const JointVector<N>& b,
                            const JointVector<N>& limit) {
      return JointVector<N>(a.cwiseAbs().cwiseMax(b.cwiseAbs()).cwiseMax(limit));
    };
    const JointReference<N> end = at_point(bridge.to);
    constexpr double rounding = 1e-9;  // [rad or m]
    const WayPeaks<N> most{range.lower.cwiseMin(present.position).array() - rounding,
                           range.upper.cwiseMax(present.position).array() + rounding,
                           highest(present.velocity, end.velocity, limits.velocity),
                           highest(present.acceleration, end.acceleration, limits.acceleration)};
    const auto peaks = peaks_between(bridge.from, bridge.to, most);
    if (within("on the way to the last point the highest velocity", peaks.velocity,
               most.velocity) &&
        within("on the way to the last point the highest acceleration", peaks.acceleration,
               most.acceleration) &&
        within("on the way to the last point the position", peaks.highest, most.highest) &&
        within("on the way to the last point the position", peaks.lowest, most.lowest, -1)) {
      return bridge;
    }
  }
  return std::nullopt;
}

}  // namespace articula
