// SPDX-License-Identifier: Apache-2.0
/// @file Several trajectories at once, each of joints of its own.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/reference/trajectory/trajectory_follower.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace articula::remote {

/// The largest number of points of a trajectory. Planners as MoveIt make ten a second, so this is a
/// motion of 100 s. A follower for six joints takes 600 kB with it, and a Remote has five.
inline constexpr int trajectory_capacity = 1024;

/// Followers of trajectories, each of joints of its own. Their owner knows which joints each has.
/// In the loop's thread. Real-time: yes, all functions but the constructor.
template <Robot R>
class TrajectoryFollowers {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Joints = JointArray<bool, joint_count>;
  using Follower = TrajectoryFollower<R, trajectory_capacity>;
  using Tolerances = TrajectoryTolerances<joint_count>;

  /// The trajectories that can be followed at once.
  static constexpr int most = std::min(joint_count, 4);
  /// One more, since a trajectory may replace several others. It begins before they end.
  static constexpr int count = joint_count == 1 ? 1 : most + 1;

  /// @param limits      of bridges and stops
  /// @param tolerances  of all trajectories
  /// @throws std::invalid_argument naming joint, limit and value
  TrajectoryFollowers(const R& robot, const MotionLimits<joint_count>& limits,
                      const Tolerances& tolerances)
      : tolerances_(tolerances) {
    followers_.reserve(count);
    for (int k = 0; k < count; ++k) {
      followers_.emplace_back(robot, JointVector<joint_count>::Zero(), limits,
                              FollowerOptions<joint_count>{.tolerances = tolerances});
    }
  }

  /// Lets a follower that has no joints go on from a reference.
  /// @param time  of that reference [s]
  void take_over(int follower, const Reference& from, double time) noexcept {
    own(follower).take_over(from, time);
  }
  /// Begins a trajectory.
  /// @param tolerances  in addition to those of all trajectories, see `overridden`
  /// @param start       its time 0 [s]; Follower::now: at once
  /// @return active, or why it was refused, see refusal(); the follower then goes on as before
  [[nodiscard]] TrajectoryOutcome start(int follower,
                                        const Trajectory<R, trajectory_capacity>& trajectory,
                                        const Tolerances& tolerances, double start) noexcept {
    return own(follower).start(trajectory, overridden(tolerances_, tolerances), start);
  }
  /// How fast trajectories are followed, see SpeedOverride.
  void set_speed(double factor) noexcept {
    for (Follower& follower : followers_) follower.set_speed(factor);
  }

  /// The reference at a time [s].
  [[nodiscard]] Reference sample(int follower, double time) noexcept {
    return own(follower).sample(time);
  }
  /// Compares a measured state with the last sample.
  /// @param joints  of the follower; those of others may be anywhere
  /// @return        whether its joints still follow it
  [[nodiscard]] bool check(int follower, JointState<joint_count> state,
                           const Joints& joints) noexcept {
    Follower& checked = own(follower);
    for (int j = 0; j < joint_count; ++j) {
      if (joints[j]) continue;
      state.position[j] = checked.reference().position[j];
      state.velocity[j] = checked.reference().velocity[j];
    }
    return checked.check(state) == TrajectoryOutcome::active || checked.moves();
  }

  /// Where the last sample lies on the last trajectory; none before its start.
  [[nodiscard]] auto progress(int follower) const noexcept { return own(follower).progress(); }
  /// What has become of the last trajectory.
  [[nodiscard]] TrajectoryOutcome outcome(int follower) const noexcept {
    return own(follower).outcome();
  }
  /// Why it was refused or has failed.
  [[nodiscard]] const TrajectoryRefusal& refusal(int follower) const noexcept {
    return own(follower).refusal();
  }

 private:
  [[nodiscard]] Follower& own(int follower) noexcept {
    return followers_[static_cast<std::size_t>(follower)];
  }
  [[nodiscard]] const Follower& own(int follower) const noexcept {
    return followers_[static_cast<std::size_t>(follower)];
  }

  Tolerances tolerances_;
  std::vector<Follower> followers_{};
};

}  // namespace articula::remote
