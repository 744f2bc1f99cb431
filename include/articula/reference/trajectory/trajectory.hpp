// SPDX-License-Identifier: Apache-2.0
/// @file A motion through points at given times.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/motion/joint_motion.hpp"
#include "articula/reference/joint_range.hpp"
#include "articula/reference/trajectory/spline_velocities.hpp"
#include "articula/reference/trajectory/trajectory_checks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>

namespace articula {

/// Options of a trajectory.
struct TrajectoryOptions {
  Interpolation interpolation = Interpolation::splines;
  bool allow_motion_at_end = false;  ///< the last point may have a velocity
  /// Points without velocities get those of the cubic spline through all positions, whose
  /// accelerations are continuous (set_spline_velocities). Otherwise positions alone make straight
  /// lines, as in ROS's joint trajectory controller.
  bool spline_velocities = false;
};

/// A motion through points at given times, checked once and then sampled at any time:
///
///     Trajectory<Q2d> trajectory({{.time_from_start = 0, .position = {0, 0}},
///                                 {.time_from_start = 1, .position = {-1, 1}}});
///     loop.reference() = trajectory.sample(loop.next_time());
///
/// It begins at its first point, wherever the robot is. Use a TrajectoryFollower to enter it from
/// the present reference, to watch tolerances, and to cancel it.
/// @tparam Capacity  largest number of points
template <Robot R, int Capacity = 32>
class Trajectory {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Point = TrajectoryPoint<joint_count>;
  using Reference = JointReference<joint_count>;
  // g++ 12 crashes on a list of points whose default members it has not met before.
  static_assert(noexcept(Point{}) || true);
  static_assert(Capacity >= 1, "a trajectory has at least one point");

  /// @param points   in the order of time
  /// @param options  kind of segments, and what the points may leave out
  /// @throws TrajectoryError (invalid_goal) in these cases; the message names point, joint, value
  ///         and limit:
  ///         - there is no point, or there are too many;
  ///         - a time is negative or not after the one before;
  ///         - a number is not finite, or a segment overflows;
  ///         - a position is outside the joint's limits, at a point or between two points;
  ///         - a velocity, or the mean velocity of a segment, is above its limit;
  ///         - the last velocity is not zero, or points out of the limits at a limit
  Trajectory(const R& robot, std::span<const Point> points, const TrajectoryOptions& options = {})
      : options_(options), size_(points.size()) {
    if (points.empty()) detail::refuse_goal({"it has no point"});
    if (points.size() > points_.size()) {
      detail::refuse_goal({points.size(), " points are more than the capacity, ", Capacity});
    }
    detail::check_times(points);
    for (std::size_t k = 0; k < size_; ++k) detail::check_point(robot, points[k], k + 1);
    std::copy(points.begin(), points.end(), points_.begin());
    if (options.spline_velocities) {
      set_spline_velocities(std::span(points_.data(), size_));
      for (std::size_t k = 0; k < size_; ++k) detail::check_point(robot, points_[k], k + 1);
    }
    for (std::size_t k = 1; k < size_ && options.interpolation == Interpolation::splines; ++k) {
      detail::check_segment(robot, points_[k - 1], points_[k], k + 1);
    }
    detail::check_end(robot, points_[size_ - 1], options.allow_motion_at_end);
  }
  Trajectory(const R& robot, std::initializer_list<Point> points,
             const TrajectoryOptions& options = {})
      : Trajectory(robot, std::span(points.begin(), points.size()), options) {}
  /// For a robot known at compile time.
  explicit Trajectory(std::span<const Point> points, const TrajectoryOptions& options = {})
    requires DescribedRobot<R>
      : Trajectory(R(), points, options) {}
  explicit Trajectory(std::initializer_list<Point> points, const TrajectoryOptions& options = {})
    requires DescribedRobot<R>
      : Trajectory(R(), points, options) {}

  /// Leaves a joint out: under a TrajectoryFollower it continues its present motion, along an older
  /// trajectory or at rest. In the points it stays at its first position, at rest.
  /// @param joint  index of the joint
  /// @throws std::invalid_argument if the robot has no such joint
  void leave_out(int joint) {
    if (joint < 0 || joint >= joint_count) {
      detail::refuse({"trajectory: joint ", joint,
                      " cannot be left out; the robot has joints 0 .. ", joint_count - 1});
    }
    left_out_[joint] = true;
    for (std::size_t k = 0; k < size_; ++k) {
      points_[k].position[joint] = points_[0].position[joint];
      if (points_[k].velocity) (*points_[k].velocity)[joint] = 0;
      if (points_[k].acceleration) (*points_[k].acceleration)[joint] = 0;
    }
  }
  /// Which joints are left out. Real-time: yes.
  [[nodiscard]] const JointArray<bool, joint_count>& left_out() const noexcept { return left_out_; }

  [[nodiscard]] std::span<const Point> points() const noexcept { return {points_.data(), size_}; }
  [[nodiscard]] Interpolation interpolation() const noexcept { return options_.interpolation; }
  /// The time of the last point [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return points().back().time_from_start; }

  /// The reference at a time since the start [s]. Before the first point and from the last one on,
  /// it is that point's position and effort, at rest. A time that is not finite gives NaN, which a
  /// loop refuses.
  /// Real-time: yes. O(N + log Capacity).
  [[nodiscard]] Reference sample(double time) const noexcept {
    if (!is_finite(time)) return detail::undefined_reference<joint_count>();
    const std::size_t next = next_point(points(), time);
    if (next > 0 && next < size_) {
      return interpolate(options_.interpolation, points_[next - 1], points_[next], time);
    }
    const Point& edge = next == 0 ? points_[0] : points_[size_ - 1];
    return {.position = edge.position, .effort = edge.effort};
  }

 private:
  std::array<Point, static_cast<std::size_t>(Capacity)> points_{};
  JointArray<bool, joint_count> left_out_{};
  TrajectoryOptions options_;
  std::size_t size_;
};

}  // namespace articula
