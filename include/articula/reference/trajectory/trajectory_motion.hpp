// SPDX-License-Identifier: Apache-2.0
/// @file The reference of joints that follow trajectories, stop or rest.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/reference/joint_stops.hpp"
#include "articula/reference/speed_override.hpp"
#include "articula/reference/trajectory/joint_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace articula {

/// The motion behind a TrajectoryFollower. Each joint follows a trajectory (JointTracks), or stops,
/// returns and rests (JointStops). A SpeedOverride is the clock of the trajectories, while stops
/// run in real time.
/// @tparam Capacity  largest number of points of a trajectory
template <Robot R, int Capacity>
class TrajectoryMotion {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Position = JointVector<joint_count>;
  using Bridge = TrajectoryBridge<joint_count>;

  /// At rest.
  /// @param position  finite [rad or m], N x 1
  /// @param limits    of stops, returns and bridges, as validate() accepts them
  /// @param speed     the clock of the trajectories
  TrajectoryMotion(const R& robot, const Position& position,
                   const MotionLimits<joint_count>& limits, const SpeedOverride& speed) noexcept
      : limits_(limits),
        range_(joint_range(robot)),
        speed_(speed),
        rest_(robot, position, limits),
        reference_{.position = position} {}

  /// The clock of the trajectories. Real-time: yes.
  [[nodiscard]] SpeedOverride& speed() noexcept { return speed_; }
  /// @copydoc speed()
  [[nodiscard]] const SpeedOverride& speed() const noexcept { return speed_; }
  /// The positions of the joints. Real-time: yes.
  [[nodiscard]] const JointRange<joint_count>& range() const noexcept { return range_; }
  /// The bridge into the last trajectory. Real-time: yes.
  [[nodiscard]] const Bridge& bridge() const noexcept { return bridge_; }
  /// The present reference. Real-time: yes.
  [[nodiscard]] const Reference& reference() const noexcept { return reference_; }
  /// Whether a joint moves. Real-time: yes.
  [[nodiscard]] bool moves() const noexcept { return tracks_.any() || stops(); }
  /// The time since the last motion ended, on the clock of the trajectories [s]. Real-time: yes.
  [[nodiscard]] double time_at_rest() const noexcept { return speed_.time() - arrival_; }

  /// Whether a trajectory can begin. A stop runs in real time, and a trajectory in its own time,
  /// which may almost stand still. A stop that would exceed the limits in the trajectory's time
  /// must end first: otherwise the motion would exceed them when the speed rises.
  /// Real-time: yes.
  [[nodiscard]] bool can_begin() const noexcept {
    if (!stops()) return true;
    const Reference own = speed_.unapply(reference_);
    const auto keeps = [](double value, double limit) {
      return std::abs(value) <= limit * (1 + 1e-9);  // rounding
    };
    for (int j = 0; j < joint_count; ++j) {
      if (tracks_.follows()[j]) continue;
      if (!keeps(own.velocity[j], limits_.velocity[j]) ||
          !keeps(own.acceleration[j], limits_.acceleration[j])) {
        return false;
      }
    }
    return speed_.speed() > 0;
  }

  /// The bridge from the present reference into a trajectory (find_bridge).
  /// @param time     the present in the trajectory's time [s]
  /// @param refusal  receives the reason if there is none
  /// Real-time: yes. O(N Capacity).
  [[nodiscard]] std::optional<Bridge> bridge_to(const Trajectory<R, Capacity>& trajectory,
                                                double time,
                                                TrajectoryRefusal& refusal) const noexcept {
    Reference from = present();
    // A joint that is left out takes its position from the points, so that it limits no bridge.
    const Reference first{.position = trajectory.points().front().position};
    copy_joints(first, from, trajectory.left_out());
    return find_bridge(from, trajectory, time, limits_, range_, refusal);
  }

  /// Begins a trajectory. Real-time: yes. O(N Capacity).
  void begin(const Trajectory<R, Capacity>& trajectory, const Bridge& bridge) noexcept {
    own_ = present();
    bridge_ = bridge;
    tracks_.begin(trajectory, bridge, speed_.time());
    speed_.restart(bridge.from.time_from_start);
  }

  /// Goes on from the reference of another source, by the fastest stop. What begins then has the
  /// requested speed. Real-time: yes. O(N).
  void take_over(const Reference& reference) noexcept {
    speed_.settle();
    reference_ = reference;
    stop(JointStops<R>::nowhere());
  }

  /// Stops all joints, and then moves them to a position.
  /// @param back  [rad or m], N x 1; see JointStops::begin
  /// Real-time: yes. O(N).
  void stop(const Position& back) noexcept {
    tracks_.clear();
    rest_.begin(reference_, back);
  }

  /// Moves on by a period [s], >= 0. Real-time: yes. O(N log Capacity).
  void advance(double period) noexcept {
    speed_.advance(period);
    const JointRange<joint_count> allowed = range_.extended_to(reference_.position);
    for (double end = tracks_.first_end(); end <= speed_.time(); end = tracks_.first_end()) {
      const double speed = speed_.speed();
      const double after = speed > 0 ? std::min(period, (speed_.time() - end) / speed) : 0;
      rest_.pass(period - after);
      end_tracks(end);
      arrival_ = end;
      period = after;
    }
    rest_.pass(period);
    if (!tracks_.all()) reference_ = rest_.reference();
    if (tracks_.any()) {
      tracks_.sample(speed_.time(), own_);
      own_.position = allowed.clamp(own_.position);  // rounding
      copy_joints(speed_.apply(own_), reference_, tracks_.follows());
    }
    if (stops()) arrival_ = speed_.time();
  }

 private:
  /// The present reference in the trajectory's time.
  [[nodiscard]] Reference present() const noexcept {
    Reference own = speed_.unapply(reference_);
    // At a speed of almost 0, the division by its square would leave nothing but rounding.
    if (speed_.speed() > 0) copy_joints(own_, own, tracks_.follows());
    return own;
  }

  /// Whether a joint that follows no trajectory stops or returns.
  [[nodiscard]] bool stops() const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!tracks_.follows()[j] && rest_.moves(j)) return true;
    }
    return false;
  }

  /// Ends the tracks that end at a time. Their joints begin to stop.
  void end_tracks(double end) noexcept {
    JointArray<bool, joint_count> ended = tracks_.follows();
    Reference last;
    tracks_.end(end, last);
    for (int j = 0; j < joint_count; ++j) ended[j] = ended[j] && !tracks_.follows()[j];
    rest_.begin(ended, speed_.apply(last));
  }

  /// Copies the references of selected joints.
  static void copy_joints(const Reference& from, Reference& to,
                          const JointArray<bool, joint_count>& selected) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!selected[j]) continue;
      set_motion(to, j, motion_of(from, j));
      to.effort[j] = from.effort[j];
    }
  }

  MotionLimits<joint_count> limits_;
  JointRange<joint_count> range_;
  SpeedOverride speed_;
  JointTracks<R, Capacity> tracks_{};
  Bridge bridge_{};
  JointStops<R> rest_;  ///< of joints that follow no trajectory
  double arrival_ = 0;  ///< the end of the motion, in the trajectory's time [s]
  Reference reference_{};
  Reference own_{};  ///< of joints that follow a trajectory, in its time
};

}  // namespace articula
