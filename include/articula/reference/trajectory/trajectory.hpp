// SPDX-License-Identifier: Apache-2.0
/// @file A motion through points at given times.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/reference/trajectory/spline_velocities.hpp"
#include "articula/reference/trajectory/trajectory_outcome.hpp"
#include "articula/reference/trajectory/trajectory_point.hpp"
#include "articula/reference/trajectory/way_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <string_view>

namespace articula {

/// What lies between the points of a trajectory.
enum class Interpolation : unsigned char {
  splines,  ///< a polynomial, see interpolate()
  none,     ///< nothing: the next point holds from the last one on
};

/// How a trajectory is to be understood.
struct TrajectoryOptions {
  Interpolation interpolation = Interpolation::splines;
  bool allow_motion_at_end = false;  ///< the last point may have a velocity
  /// Points without velocities get those of the cubic spline through all positions, which is smooth
  /// to its accelerations (set_spline_velocities). Without this, positions alone make straight
  /// lines, as in ROS's joint trajectory controller.
  bool spline_velocities = false;
};

/// A motion through points at given times, checked and ready to be sampled:
///
///     Trajectory<Q2d> trajectory({{.time_from_start = 0, .position = {0, 0}},
///                                 {.time_from_start = 1, .position = {-1, 1}}});
///     loop.reference() = trajectory.sample(loop.next_time());
///
/// It begins at its first point, wherever the robot is; a TrajectoryFollower goes from where the
/// robot is asked to be now, watches tolerances, and can be canceled.
/// @tparam R         the robot
/// @tparam Capacity  most points there can be
template <Robot R, int Capacity = 32>
class Trajectory {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  /// Up to which a last point stands still: ROS's bound, the resolution of a float [rad/s or m/s].
  static constexpr double still_velocity = 0x1p-23;
  using Point = TrajectoryPoint<joint_count>;
  using Reference = JointReference<joint_count>;
  // g++ 12 crashes on a list of points whose default members it has not met before.
  static_assert(noexcept(Point{}) || true);
  static_assert(Capacity >= 1, "a trajectory has at least one point");

  /// @param robot    whose joints these are
  /// @param points   in the order of time
  /// @param options  what lies between them
  /// @throws TrajectoryError (invalid_goal) if there is no point or too many, a time is negative or
  ///         not after the one before, a number is not finite or overflows, a position is beyond
  ///         the joint's limits, at a point or on the way to it, a velocity or the mean velocity to
  ///         a point above its limit, or the last velocity is not zero, or leads out of the limits
  ///         of a joint that stands at one; the message names point, joint, value and limit
  Trajectory(const R& robot, std::span<const Point> points, const TrajectoryOptions& options = {})
      : options_(options), size_(points.size()) {
    if (points.empty()) refuse({"it has no point"});
    if (points.size() > points_.size()) {
      refuse({points.size(), " points are more than the capacity, ", Capacity});
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      check_time(points, k);
      check_numbers(points[k], k, robot);
    }
    std::copy(points.begin(), points.end(), points_.begin());
    if (options.spline_velocities) {
      set_spline_velocities(std::span(points_.data(), size_));
      for (std::size_t k = 0; k < size_; ++k) check_numbers(points_[k], k, robot);
    }
    for (std::size_t k = 1; k < size_ && options.interpolation == Interpolation::splines; ++k) {
      check_way(this->points(), k, robot);
    }
    check_end(points_[size_ - 1], options.allow_motion_at_end, robot);
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

  /// Leaves a joint out: under a TrajectoryFollower it goes on with what it does, along an older
  /// trajectory or at rest. In the points it stays at its first position, at rest.
  /// @param joint  index of the joint
  /// @throws std::invalid_argument if the robot has no such joint
  void leave_out(int joint) {
    if (joint < 0 || joint >= joint_count) {
      detail::refuse({"trajectory: joint ", joint, " is left out, of ", joint_count, " joints"});
    }
    left_out_[static_cast<std::size_t>(joint)] = true;
    for (std::size_t k = 0; k < size_; ++k) {
      points_[k].position[joint] = points_[0].position[joint];
      if (points_[k].velocity) (*points_[k].velocity)[joint] = 0;
      if (points_[k].acceleration) (*points_[k].acceleration)[joint] = 0;
    }
  }
  /// Whether a joint is left out. Real-time: yes.
  [[nodiscard]] bool leaves_out(int joint) const noexcept {
    return left_out_[static_cast<std::size_t>(joint)];
  }

  [[nodiscard]] std::span<const Point> points() const noexcept { return {points_.data(), size_}; }
  [[nodiscard]] Interpolation interpolation() const noexcept { return options_.interpolation; }
  /// The time of the last point [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return points().back().time_from_start; }

  /// The reference at a time since the start [s]. Until the first point it is that point's position
  /// at rest, from the last one on the last one's, with its effort. A time that is not finite gives
  /// NaN, which a loop refuses.
  /// Real-time: yes. O(N + log Capacity).
  [[nodiscard]] Reference sample(double time) const noexcept {
    Reference reference;
    if (!is_finite(time)) {
      reference.position.setConstant(std::numeric_limits<double>::quiet_NaN());
      return reference;
    }
    const std::size_t next = next_point(time);
    if (next > 0 && next < size_) return between(points_[next - 1], points_[next], time);
    const Point& edge = next == 0 ? points_[0] : points_[size_ - 1];
    reference.position = edge.position;
    reference.effort = edge.effort;
    return reference;
  }

  /// The index of the first point after a time [s]; the number of points if there is none.
  /// Real-time: yes. O(log Capacity).
  [[nodiscard]] std::size_t next_point(double time) const noexcept {
    const auto all = points();
    const auto later = [](double t, const Point& point) { return t < point.time_from_start; };
    return static_cast<std::size_t>(std::upper_bound(all.begin(), all.end(), time, later) -
                                    all.begin());
  }

  /// The reference between two points at a time since the start [s], with this trajectory's
  /// interpolation. Real-time: yes. O(N).
  [[nodiscard]] Reference between(const Point& a, const Point& b, double time) const noexcept {
    if (options_.interpolation == Interpolation::none) return at_point(b);
    return interpolate(a, b, time - a.time_from_start);
  }

 private:
  [[noreturn]] static void refuse(detail::MessageParts parts) {
    throw TrajectoryError(TrajectoryOutcome::invalid_goal, detail::message_of(parts));
  }

  static void check_time(std::span<const Point> points, std::size_t k) {
    const double time = points[k].time_from_start;
    if (!is_finite(time) || time < 0) {
      refuse({"point ", k + 1, ": time_from_start ", time, " s is not a number >= 0"});
    }
    if (k > 0 && !(time > points[k - 1].time_from_start)) {
      refuse({"point ", k + 1, ": time_from_start ", time,
              " s is not after that of the point before, ", points[k - 1].time_from_start, " s"});
    }
  }

  static void check_numbers(const Point& point, std::size_t k, const R& robot) {
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      const auto complain = [&](std::string_view what, double value, detail::MessageParts reason) {
        refuse({"point ", k + 1, " at ", point.time_from_start, " s: ", what, " ", value,
                " of joint '", joint.name.view(), "' ", detail::message_of(reason)});
      };
      const auto check_finite = [&](std::string_view what, double value) {
        if (!is_finite(value)) complain(what, value, {"is not a finite number"});
      };
      check_finite("position", point.position[j]);
      check_finite("effort", point.effort[j]);
      if (point.acceleration) check_finite("acceleration", (*point.acceleration)[j]);
      if (point.position[j] < joint.limits.lower || point.position[j] > joint.limits.upper) {
        complain("position", point.position[j],
                 {"is outside its limits ", joint.limits.lower, " .. ", joint.limits.upper});
      }
      if (!point.velocity) continue;
      check_finite("velocity", (*point.velocity)[j]);
      if (std::abs((*point.velocity)[j]) > joint.limits.velocity) {
        complain("velocity", (*point.velocity)[j], {"is above its limit ", joint.limits.velocity});
      }
    }
  }

  static void check_way(std::span<const Point> points, std::size_t k, const R& robot) {
    const Point &a = points[k - 1], &b = points[k];
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      const double speed =
          std::abs(b.position[j] - a.position[j]) / (b.time_from_start - a.time_from_start);
      if (is_finite(speed) && speed <= joint.limits.velocity * (1 + 1e-9)) continue;  // rounding
      refuse({"point ", k + 1, " at ", b.time_from_start, " s: joint '", joint.name.view(),
              "' would need a mean velocity of ", speed, " from the point before, its limit is ",
              joint.limits.velocity});
    }
    const double period = b.time_from_start - a.time_from_start;
    if (!is_finite(interpolate(a, b, period / 2)) || !is_finite(interpolate(a, b, period))) {
      refuse({"point ", k + 1, " at ", b.time_from_start,
              " s: the way from the point before overflows"});
    }
    constexpr double rounding = 1e-9;  // [rad or m]
    WayPeaks<joint_count> limits;      // of velocity and acceleration: not asked here
    limits.velocity.setConstant(std::numeric_limits<double>::infinity());
    limits.acceleration = limits.velocity;
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      limits.lowest[j] = joint.limits.lower - rounding;
      limits.highest[j] = joint.limits.upper + rounding;
    }
    const WayPeaks<joint_count> peaks = peaks_between(a, b, limits);
    for (int j = 0; j < joint_count; ++j) {
      const bool below = peaks.lowest[j] < limits.lowest[j];
      if (!below && !(peaks.highest[j] > limits.highest[j])) continue;
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      refuse({"point ", k + 1, " at ", b.time_from_start,
              " s: on the way from the point before joint '", joint.name.view(),
              "' would swing out to ", below ? peaks.lowest[j] : peaks.highest[j],
              ", outside its limits ", joint.limits.lower, " .. ", joint.limits.upper});
    }
  }

  static void check_end(const Point& last, bool may_move, const R& robot) {
    if (!last.velocity) return;
    for (int j = 0; j < joint_count; ++j) {
      const double v = (*last.velocity)[j], q = last.position[j];
      if (std::abs(v) <= still_velocity) continue;
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      const auto complain = [&](detail::MessageParts reason) {
        refuse({"the last point moves: velocity ", v, " of joint '", joint.name.view(), "' ",
                detail::message_of(reason)});
      };
      if (!may_move) complain({"is not 0"});
      if (q == (v < 0 ? joint.limits.lower : joint.limits.upper)) {
        complain({"leads out of its limits ", joint.limits.lower, " .. ", joint.limits.upper});
      }
    }
  }

  std::array<Point, static_cast<std::size_t>(Capacity)> points_{};
  std::array<bool, static_cast<std::size_t>(joint_count)> left_out_{};
  TrajectoryOptions options_;
  std::size_t size_;
};

}  // namespace articula
