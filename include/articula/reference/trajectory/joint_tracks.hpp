// SPDX-License-Identifier: Apache-2.0
/// @file Which trajectory each joint follows.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/reference/trajectory/trajectory.hpp"
#include "articula/reference/trajectory/trajectory_bridge.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace articula {

/// The part of a trajectory that one joint follows: the way in, and the points from there on.
/// @tparam Capacity  most points
template <int Capacity>
struct JointTrack {
  static_assert(noexcept(TrajectoryPoint<1>{}) || true);  // see Trajectory

  std::array<TrajectoryPoint<1>, static_cast<std::size_t>(Capacity)> points{};
  std::size_t size = 0;
  TrajectoryPoint<1> from{}, to{};  ///< the way in (TrajectoryBridge), up to the first point
  double shift = 0;                 ///< whole turns of a continuous joint [rad]
  Interpolation interpolation = Interpolation::splines;

  /// When it ends, in the trajectory's time [s]. Real-time: yes.
  [[nodiscard]] double end() const noexcept { return points[size - 1].time_from_start; }

  /// The reference at a time of the trajectory before its end [s].
  /// Real-time: yes. O(log Capacity).
  [[nodiscard]] JointReference<1> sample(double time) const noexcept {
    const auto last = points.begin() + static_cast<std::ptrdiff_t>(size);
    const auto later = [](double t, const auto& point) { return t < point.time_from_start; };
    const auto next = std::upper_bound(points.begin(), last, time, later);
    const bool splines = interpolation == Interpolation::splines;
    if (next == points.begin()) {
      if (splines) return interpolate(from, to, time - from.time_from_start);
      return {from.position, JointVector<1>::Zero(), JointVector<1>::Zero(), from.effort};
    }
    const TrajectoryPoint<1>& before = *(next - 1);
    auto reference =
        splines ? interpolate(before, *next, time - before.time_from_start) : at_point(*next);
    reference.position[0] += shift;
    return reference;
  }
};

/// The tracks of all joints of a robot. Joints that a trajectory leaves out keep the track that
/// they have, so joints may follow trajectories of different age. Each has a time of its own: the
/// present time of the newest trajectory and an offset.
/// @tparam R         the robot
/// @tparam Capacity  most points of a trajectory
template <Robot R, int Capacity>
class JointTracks {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;

  /// Lets the joints that a trajectory does not leave out follow it.
  /// @param bridge  the way into it
  /// @param time    the time of the trajectories that are followed now [s]; from here on it is the
  ///                time at which the bridge begins
  /// Real-time: yes. O(N Capacity).
  void begin(const Trajectory<R, Capacity>& trajectory, const TrajectoryBridge<joint_count>& bridge,
             double time) noexcept {
    const auto points = trajectory.points().subspan(bridge.index);
    for (int j = 0; j < joint_count; ++j) {
      if (trajectory.leaves_out(j)) {
        offset_[j] += time - bridge.from.time_from_start;
        continue;
      }
      JointTrack<Capacity>& track = tracks_[static_cast<std::size_t>(j)];
      for (std::size_t k = 0; k < points.size(); ++k) track.points[k] = of_joint(points[k], j);
      track.size = points.size();
      track.from = of_joint(bridge.from, j);
      track.to = of_joint(bridge.to, j);
      track.shift = bridge.shift[j];
      track.interpolation = trajectory.interpolation();
      offset_[j] = 0;
      follows_[static_cast<std::size_t>(j)] = true;
    }
  }

  /// Lets no joint follow anything. Real-time: yes.
  void clear() noexcept { follows_.fill(false); }

  /// Whether a joint follows a track. Real-time: yes.
  [[nodiscard]] bool follows(int joint) const noexcept {
    return follows_[static_cast<std::size_t>(joint)];
  }
  /// Whether any does. Real-time: yes. O(N).
  [[nodiscard]] bool any() const noexcept {
    return std::find(follows_.begin(), follows_.end(), true) != follows_.end();
  }
  /// When the first of the tracks that are followed ends [s]; infinity if none is followed.
  /// Real-time: yes. O(N).
  [[nodiscard]] double first_end() const noexcept {
    double first = std::numeric_limits<double>::infinity();
    for (int j = 0; j < joint_count; ++j) {
      if (follows(j)) first = std::min(first, end_of(j));
    }
    return first;
  }

  /// Sets the references of the joints that follow a track; those of the others stay.
  /// @param time  not after first_end() [s]
  /// Real-time: yes. O(N log Capacity).
  void sample(double time, Reference& reference) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (follows(j)) set(reference, j, track(j).sample(time + offset_[j]));
    }
  }

  /// Ends the tracks that are over at a time, and sets the references of their joints to their last
  /// points. A velocity that ROS takes for 0 is 0, and then there is no acceleration either.
  /// Real-time: yes. O(N).
  void end(double time, Reference& reference) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!follows(j) || end_of(j) > time) continue;
      JointReference<1> last = at_point(track(j).points[track(j).size - 1]);
      last.position[0] += track(j).shift;
      if (std::abs(last.velocity[0]) <= Trajectory<R, Capacity>::still_velocity) {
        last.velocity[0] = last.acceleration[0] = 0;
      }
      set(reference, j, last);
      follows_[static_cast<std::size_t>(j)] = false;
    }
  }

 private:
  [[nodiscard]] const JointTrack<Capacity>& track(int j) const noexcept {
    return tracks_[static_cast<std::size_t>(j)];
  }
  [[nodiscard]] double end_of(int j) const noexcept { return track(j).end() - offset_[j]; }

  [[nodiscard]] static TrajectoryPoint<1> of_joint(const TrajectoryPoint<joint_count>& point,
                                                   int j) noexcept {
    TrajectoryPoint<1> own;
    own.time_from_start = point.time_from_start;
    own.position[0] = point.position[j];
    if (point.velocity) own.velocity = JointVector<1>((*point.velocity)[j]);
    if (point.acceleration) own.acceleration = JointVector<1>((*point.acceleration)[j]);
    own.effort[0] = point.effort[j];
    return own;
  }
  static void set(Reference& reference, int j, const JointReference<1>& own) noexcept {
    reference.position[j] = own.position[0];
    reference.velocity[j] = own.velocity[0];
    reference.acceleration[j] = own.acceleration[0];
    reference.effort[j] = own.effort[0];
  }

  std::array<JointTrack<Capacity>, static_cast<std::size_t>(joint_count)> tracks_{};
  std::array<bool, static_cast<std::size_t>(joint_count)> follows_{};
  JointVector<joint_count> offset_ = JointVector<joint_count>::Zero();
};

}  // namespace articula
