// SPDX-License-Identifier: Apache-2.0
/// @file Checks of the points of a trajectory.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/reference/trajectory/trajectory_outcome.hpp"
#include "articula/reference/trajectory/trajectory_point.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace articula {

/// The velocity up to which the last point of a trajectory counts as standing still: ROS's bound,
/// the resolution of a float [rad/s or m/s].
inline constexpr double still_velocity = 0x1p-23;

namespace detail {

// Each of these functions throws TrajectoryError (invalid_goal).

/// Checks that times are >= 0 and strictly increasing.
template <int N>
void check_times(std::span<const TrajectoryPoint<N>> points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double time = points[k].time_from_start;
    if (!is_finite(time) || time < 0) {
      refuse_goal({"point ", k + 1, ": time_from_start ", time, " s is not a number >= 0"});
    }
    if (k > 0 && !(time > points[k - 1].time_from_start)) {
      refuse_goal({"point ", k + 1, ": time_from_start ", time,
                   " s is not after that of the point before, ", points[k - 1].time_from_start,
                   " s"});
    }
  }
}

/// Checks that the numbers of a point are finite and within the limits of position and velocity.
/// @param number  of the point, for the message
template <Robot R>
void check_point(const R& robot, const TrajectoryPoint<joint_count<R>>& point, std::size_t number) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    const auto refuse_value = [&](std::string_view what, double value, MessageParts reason) {
      refuse_goal({"point ", number, " at ", point.time_from_start, " s: ", what, " ", value,
                   " of joint '", joint.name.view(), "' ", message_of(reason)});
    };
    const auto check_finite = [&](std::string_view what, double value) {
      if (!is_finite(value)) refuse_value(what, value, {"is not a finite number"});
    };
    check_finite("position", point.position[j]);
    check_finite("effort", point.effort[j]);
    if (point.acceleration) check_finite("acceleration", (*point.acceleration)[j]);
    if (point.position[j] < joint.limits.lower || point.position[j] > joint.limits.upper) {
      refuse_value("position", point.position[j],
                   {"is outside its limits ", joint.limits.lower, " .. ", joint.limits.upper});
    }
    if (!point.velocity) continue;
    check_finite("velocity", (*point.velocity)[j]);
    if (std::abs((*point.velocity)[j]) > joint.limits.velocity) {
      refuse_value("velocity", (*point.velocity)[j],
                   {"is above its limit ", joint.limits.velocity});
    }
  }
}

/// Checks that a segment does not overflow, that its mean velocity is within the limits, and that
/// its positions are.
/// @param number  of point b, for the message
template <Robot R, int N = joint_count<R>>
void check_segment(const R& robot, const TrajectoryPoint<N>& a, const TrajectoryPoint<N>& b,
                   std::size_t number) {
  const double T = b.time_from_start - a.time_from_start;
  const auto refuse_segment = [&](MessageParts reason) {
    refuse_goal({"point ", number, " at ", b.time_from_start, " s: ", message_of(reason)});
  };
  for (int j = 0; j < N; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    const double speed = std::abs(b.position[j] - a.position[j]) / T;
    if (is_finite(speed) && speed <= joint.limits.velocity * (1 + 1e-9)) continue;  // rounding
    refuse_segment({"joint '", joint.name.view(), "' would need a mean velocity of ", speed,
                    " from the point before, its limit is ", joint.limits.velocity});
  }
  if (!is_finite(interpolate(a, b, T / 2)) || !is_finite(interpolate(a, b, T))) {
    refuse_segment({"the segment from the point before overflows"});
  }
  constexpr double rounding = 1e-9;  // [rad or m]
  const JointRange<N> range = joint_range(robot);
  const JointRange<N> limited = range.extended_to(range.lower, rounding);  // by the margin alone
  const JointVector<N> unlimited =
      JointVector<N>::Constant(std::numeric_limits<double>::infinity());
  const SegmentPeaks<N> limits{limited.lower, limited.upper, unlimited, unlimited};
  const SegmentPeaks<N> peaks = segment_peaks(a, b, limits);
  for (int j = 0; j < N; ++j) {
    const bool below = peaks.lowest[j] < limits.lowest[j];
    if (!below && !(peaks.highest[j] > limits.highest[j])) continue;
    refuse_segment({"between the point before and this one, joint '",
                    model_of(robot).joints[j].name.view(), "' would swing out to ",
                    below ? peaks.lowest[j] : peaks.highest[j], ", outside its limits ",
                    range.lower[j], " .. ", range.upper[j]});
  }
}

/// Checks that the last point stands still, or moves away from the limits of position.
template <Robot R>
void check_end(const R& robot, const TrajectoryPoint<joint_count<R>>& last, bool may_move) {
  if (!last.velocity) return;
  for (int j = 0; j < joint_count<R>; ++j) {
    const double v = (*last.velocity)[j], q = last.position[j];
    if (std::abs(v) <= still_velocity) continue;
    const JointProperties& joint = model_of(robot).joints[j];
    const auto refuse_velocity = [&](MessageParts reason) {
      refuse_goal({"the last point moves: velocity ", v, " of joint '", joint.name.view(), "' ",
                   message_of(reason)});
    };
    if (!may_move) refuse_velocity({"is not 0"});
    if (q == (v < 0 ? joint.limits.lower : joint.limits.upper)) {
      refuse_velocity({"leads out of its limits ", joint.limits.lower, " .. ", joint.limits.upper});
    }
  }
}

}  // namespace detail
}  // namespace articula
