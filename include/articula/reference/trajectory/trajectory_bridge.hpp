// SPDX-License-Identifier: Apache-2.0
/// @file The segment from the present reference into a trajectory.
#pragma once

#include "articula/motion/motion_limits.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/reference/trajectory/trajectory.hpp"
#include "articula/reference/trajectory/trajectory_outcome.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

namespace articula {

/// The segment from the present reference to a point of a trajectory. It replaces the points before
/// that one.
template <int N>
struct TrajectoryBridge {
  TrajectoryPoint<N> from{};                      ///< the present, in the trajectory's time
  TrajectoryPoint<N> to{};                        ///< the point of the trajectory, shifted
  std::size_t index = 0;                          ///< of that point
  JointVector<N> shift = JointVector<N>::Zero();  ///< whole turns of continuous joints [rad], N x 1
};

/// The reference along a trajectory that was entered by a bridge.
/// @param time  of the trajectory [s]
/// Real-time: yes. O(N + log Capacity).
template <Robot R, int Capacity, int N = joint_count<R>>
[[nodiscard]] JointReference<N> sample(const Trajectory<R, Capacity>& trajectory,
                                       const TrajectoryBridge<N>& bridge, double time) noexcept {
  if (time < bridge.to.time_from_start) {
    if (trajectory.interpolation() == Interpolation::none) {
      return {.position = bridge.from.position, .effort = bridge.from.effort};
    }
    return interpolate(bridge.from, bridge.to, time - bridge.from.time_from_start);
  }
  JointReference<N> reference = trajectory.sample(time);
  reference.position += bridge.shift;
  return reference;
}

/// Finds the bridge into a trajectory.
///
/// - From rest, it is the segment from a point at rest to the trajectory's next point
///   (interpolate).
/// - From motion, it is a quintic. It ends with the velocity and acceleration that the trajectory
///   has from that point on, even if the point does not specify them.
/// - A point is too close if the bridge to it would exceed the velocity limit on average. It also
///   is if the bridge would exceed a limit of position, velocity or acceleration anywhere. The
///   trajectory skips it like points in the past. The start and the end of the bridge may be beyond
///   these limits.
///
/// @param present     the present reference, in the trajectory's time
/// @param trajectory  the trajectory
/// @param time        the present in the trajectory's time [s]
/// @param limits      V and A are used
/// @param range       positions of the joints; continuous joints take the short way round
/// @param refusal     receives the reason why the last point cannot be reached, if none can
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
  const bool moves = !present.velocity.isZero(0) || !present.acceleration.isZero(0);
  for (std::size_t k = next_point(points, time); k < points.size(); ++k) {
    TrajectoryBridge<N> bridge{
        {time, present.position, present.velocity, present.acceleration, present.effort},
        points[k],
        k};
    for (int j = 0; j < N; ++j) {
      if (range.turn[j] == 0) continue;
      const double apart = present.position[j] - points[k].position[j];
      bridge.shift[j] = range.turn[j] * std::round(apart / range.turn[j]);
      bridge.to.position[j] += bridge.shift[j];
    }
    if (trajectory.interpolation() == Interpolation::none) return bridge;

    const double period = points[k].time_from_start - time;
    const JointVector<N> mean = for_each_joint<N>([&](int j) noexcept {
      return std::abs(bridge.to.position[j] - present.position[j]) / period;
    });
    if (!within("before the last point the mean velocity", mean, limits.velocity)) continue;

    if (moves) {
      const JointReference<N> onward =
          k + 1 < points.size() ? interpolate(points[k], points[k + 1], 0) : at_point(points[k]);
      bridge.to.velocity = onward.velocity;
      bridge.to.acceleration = onward.acceleration;
    }
    const auto highest = [](const JointVector<N>& a, const JointVector<N>& b,
                            const JointVector<N>& limit) {
      return for_each_joint<N>(
          [&](int j) noexcept { return std::max({std::abs(a[j]), std::abs(b[j]), limit[j]}); });
    };
    const JointReference<N> end = at_point(bridge.to);
    constexpr double rounding = 1e-9;  // [rad or m]
    const JointRange<N> allowed = range.extended_to(present.position, rounding);
    const SegmentPeaks<N> most{
        allowed.lower, allowed.upper, highest(present.velocity, end.velocity, limits.velocity),
        highest(present.acceleration, end.acceleration, limits.acceleration)};
    const auto peaks = segment_peaks(bridge.from, bridge.to, most);
    if (within("before the last point the highest velocity", peaks.velocity, most.velocity) &&
        within("before the last point the highest acceleration", peaks.acceleration,
               most.acceleration) &&
        within("before the last point the position", peaks.highest, most.highest) &&
        within("before the last point the position", peaks.lowest, most.lowest, -1)) {
      return bridge;
    }
  }
  return std::nullopt;
}

}  // namespace articula
