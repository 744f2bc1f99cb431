// SPDX-License-Identifier: Apache-2.0
/// @file The trajectory that each joint follows.
#pragma once

#include "articula/motion/joint_motion.hpp"
#include "articula/reference/trajectory/trajectory.hpp"
#include "articula/reference/trajectory/trajectory_bridge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace articula {

/// The part of a trajectory that one joint follows: the bridge, and the points after it.
/// @tparam Capacity  largest number of points
template <int Capacity>
struct JointTrack {
  static_assert(noexcept(TrajectoryPoint<1>{}) || true);  // see Trajectory

  std::array<TrajectoryPoint<1>, static_cast<std::size_t>(Capacity)> points{};
  std::size_t size = 0;
  TrajectoryPoint<1> from{}, to{};  ///< the bridge up to the first point (TrajectoryBridge)
  double shift = 0;                 ///< whole turns of a continuous joint [rad]
  Interpolation interpolation = Interpolation::splines;

  /// The end in the trajectory's time [s]. Real-time: yes.
  [[nodiscard]] double end() const noexcept { return points[size - 1].time_from_start; }

  /// The reference at a time of the trajectory before its end [s].
  /// Real-time: yes. O(log Capacity).
  [[nodiscard]] JointReference<1> sample(double time) const noexcept {
    const std::size_t next =
        next_point(std::span<const TrajectoryPoint<1>>(points.data(), size), time);
    if (next == 0) {
      if (interpolation == Interpolation::splines) {
        return interpolate(from, to, time - from.time_from_start);
      }
      return {.position = from.position, .effort = from.effort};
    }
    auto reference = interpolate(interpolation, points[next - 1], points[next], time);
    reference.position[0] += shift;
    return reference;
  }
};

/// The tracks of all joints of a robot. Joints that a trajectory leaves out keep their tracks, so
/// joints may follow trajectories of different age. The time of a track is the time of the newest
/// trajectory plus an offset.
/// @tparam Capacity  largest number of points of a trajectory
template <Robot R, int Capacity>
class JointTracks {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;

  /// Starts a trajectory for all joints that it does not leave out.
  /// @param bridge  the bridge into the trajectory
  /// @param time    the present in the time of the tracks [s]; from here on, the time at which the
  ///                bridge begins takes its place
  /// Real-time: yes. O(N Capacity).
  void begin(const Trajectory<R, Capacity>& trajectory, const TrajectoryBridge<joint_count>& bridge,
             double time) noexcept {
    const auto points = trajectory.points().subspan(bridge.index);
    for (int j = 0; j < joint_count; ++j) {
      if (trajectory.left_out()[j]) {
        offset_[j] += time - bridge.from.time_from_start;
        continue;
      }
      JointTrack<Capacity>& track = tracks_[j];
      for (std::size_t k = 0; k < points.size(); ++k) track.points[k] = of_joint(points[k], j);
      track.size = points.size();
      track.from = of_joint(bridge.from, j);
      track.to = of_joint(bridge.to, j);
      track.shift = bridge.shift[j];
      track.interpolation = trajectory.interpolation();
      offset_[j] = 0;
      follows_[j] = true;
    }
  }

  /// Ends all tracks. Real-time: yes.
  void clear() noexcept { follows_.fill(false); }

  /// Which joints follow a track. Real-time: yes.
  [[nodiscard]] const JointArray<bool, joint_count>& follows() const noexcept { return follows_; }
  /// Whether any joint follows a track. Real-time: yes. O(N).
  [[nodiscard]] bool any() const noexcept {
    return std::ranges::find(follows_, true) != follows_.end();
  }
  /// Whether all joints follow a track. Real-time: yes. O(N).
  [[nodiscard]] bool all() const noexcept {
    return std::ranges::find(follows_, false) == follows_.end();
  }
  /// The first end of a track that a joint follows [s]; infinity if there is none.
  /// Real-time: yes. O(N).
  [[nodiscard]] double first_end() const noexcept {
    double first = std::numeric_limits<double>::infinity();
    for (int j = 0; j < joint_count; ++j) {
      if (follows_[j]) first = std::min(first, end_of(j));
    }
    return first;
  }

  /// Sets the references of the joints that follow a track. Those of other joints stay.
  /// @param time  not after first_end() [s]
  /// Real-time: yes. O(N log Capacity).
  void sample(double time, Reference& reference) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (follows_[j]) set(reference, j, tracks_[j].sample(time + offset_[j]));
    }
  }

  /// Ends the tracks that are over at a time, and sets the references of their joints to the last
  /// points. A velocity up to still_velocity becomes 0, together with the acceleration.
  /// Real-time: yes. O(N).
  void end(double time, Reference& reference) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!follows_[j] || end_of(j) > time) continue;
      JointReference<1> last = at_point(tracks_[j].points[tracks_[j].size - 1]);
      last.position[0] += tracks_[j].shift;
      if (std::abs(last.velocity[0]) <= still_velocity) {
        last.velocity[0] = last.acceleration[0] = 0;
      }
      set(reference, j, last);
      follows_[j] = false;
    }
  }

 private:
  [[nodiscard]] double end_of(int j) const noexcept { return tracks_[j].end() - offset_[j]; }

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
    set_motion(reference, j, motion_of(own, 0));
    reference.effort[j] = own.effort[0];
  }

  JointArray<JointTrack<Capacity>, joint_count> tracks_{};
  JointArray<bool, joint_count> follows_{};
  JointVector<joint_count> offset_ = JointVector<joint_count>::Zero();
};

}  // namespace articula
