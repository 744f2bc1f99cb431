// SPDX-License-Identifier: Apache-2.0
/// @file Motions of all joints from point to point, and stops, with limited jerk.
#pragma once

#include "articula/core/joint_array.hpp"
#include "articula/motion/fastest_stop.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/motion/rest_to_rest.hpp"
#include "articula/reference/joint_range.hpp"

#include <algorithm>
#include <limits>

namespace articula {

/// A motion of all joints to rest, as a function of the time since its start:
///
///     JerkLimitedProfile<Q2d> profile({0, 0}, {-1, 1}, limits);
///     loop.reference() = profile.sample(loop.next_time());
///
/// - From rest to rest, all joints arrive together. The slowest joint takes its least time
///   (rest_to_rest). The motions of the others are stretched in time by a factor s. It divides
///   their velocities by s, accelerations by s^2 and jerks by s^3.
/// - A stop is the fastest one of each joint alone (fastest_stop).
///
/// Every sample keeps the limits to the last bit. Only a stop within a range may exceed them.
///
/// For a start or a target in motion, use StateToStateProfile; for points at given times,
/// Trajectory.
template <Robot R>
class JerkLimitedProfile {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Limits = MotionLimits<joint_count>;

  /// From rest to rest.
  /// @param from    start [rad or m], N x 1; may be outside the joints' limits
  /// @param to      end [rad or m], N x 1
  /// @param limits  V, A, J
  /// @throws std::invalid_argument if a limit is out of range, a position is not finite or `to` is
  ///         outside a joint's limits
  /// @throws std::invalid_argument if the duration overflows; messages name joint, value and, if
  ///         there is one, limit
  JerkLimitedProfile(const R& robot, const JointVector<joint_count>& from,
                     const JointVector<joint_count>& to, const Limits& limits) {
    validate(robot, limits);
    detail::check_positions(robot, "profile", to);
    *this = move(from, to, limits);
    for (int j = 0; j < joint_count; ++j) {
      if (is_finite(from[j]) && is_finite(duration_)) continue;
      detail::refuse({"profile: from ", from[j], " to ", to[j], " joint '",
                      model_of(robot).joints[j].name.view(), "' never arrives"});
    }
  }
  /// For a robot known at compile time.
  JerkLimitedProfile(const JointVector<joint_count>& from, const JointVector<joint_count>& to,
                     const Limits& limits)
    requires DescribedRobot<R>
      : JerkLimitedProfile(R(), from, to, limits) {}

  /// From rest to rest, without the constructor's checks.
  /// @param from, to  finite [rad or m], N x 1
  /// @param limits    that validate() accepts
  /// @param effort    feed-forward effort, constant [N m or N], N x 1
  /// Real-time: yes. O(N).
  [[nodiscard]] static JerkLimitedProfile move(
      const JointVector<joint_count>& from, const JointVector<joint_count>& to,
      const Limits& limits,
      const JointVector<joint_count>& effort = JointVector<joint_count>::Zero()) noexcept {
    JerkLimitedProfile profile;
    profile.effort_ = effort;
    for (int j = 0; j < joint_count; ++j) {
      profile.lower_[j] = std::min(from[j], to[j]);
      profile.upper_[j] = std::max(from[j], to[j]);
      profile.motions_[j] =
          rest_to_rest(from[j], to[j], limits.velocity[j], limits.acceleration[j], limits.jerk[j]);
      profile.duration_ = std::max(profile.duration_, profile.motions_[j].duration());
    }
    for (int j = 0; j < joint_count; ++j) {
      const double own = profile.motions_[j].duration();
      profile.pace_[j] = own < profile.duration_ ? own / profile.duration_ : 1;
    }
    return profile;
  }

  /// The fastest stop, at any position or within a range (stop_within). It begins with the position
  /// and velocity of a reference. So does the acceleration, unless the velocity would exceed V
  /// while it fades. A velocity beyond V only falls. The reference's effort stays, since it may
  /// carry the robot's weight.
  /// @param from    the last reference of the joints
  /// @param limits  that validate() accepts
  /// @param lower   range of positions [rad or m], N x 1; where the fastest stop would leave it,
  /// @param upper   acceleration and jerk are as much higher as necessary
  /// Real-time: yes. O(N).
  [[nodiscard]] static JerkLimitedProfile stop(
      const Reference& from, const Limits& limits,
      const JointVector<joint_count>& lower = everywhere(-1),
      const JointVector<joint_count>& upper = everywhere(1)) noexcept {
    JerkLimitedProfile profile;
    profile.effort_ = from.effort;
    for (int j = 0; j < joint_count; ++j) {
      if (from.position[j] >= lower[j]) profile.lower_[j] = lower[j];
      if (from.position[j] <= upper[j]) profile.upper_[j] = upper[j];
      profile.motions_[j] = stop_within(motion_of(from, j), limits.velocity[j],
                                        limits.acceleration[j], limits.jerk[j], lower[j], upper[j]);
      profile.duration_ = std::max(profile.duration_, profile.motions_[j].duration());
    }
    return profile;
  }

  /// The time at which all joints rest [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return duration_; }

  /// The reference at a time since the start [s]; before 0 as at 0, after duration() at rest. A
  /// time that is not finite gives NaN, which a loop refuses.
  /// Real-time: yes. O(N).
  [[nodiscard]] Reference sample(double time) const noexcept {
    if (!is_finite(time)) return detail::undefined_reference<joint_count>();
    Reference reference{.effort = effort_};
    for (int j = 0; j < joint_count; ++j) {
      const double own_time = time < duration_ ? std::max(0.0, time * pace_[j]) : duration_;
      const auto [q, v, a] = motions_[j].sample(own_time);
      // The clamp removes rounding.
      set_motion(
          reference, j,
          {std::min(std::max(q, lower_[j]), upper_[j]), v * pace_[j], a * pace_[j] * pace_[j]});
    }
    return reference;
  }

 private:
  JerkLimitedProfile() = default;

  [[nodiscard]] static JointVector<joint_count> everywhere(double side) noexcept {
    return JointVector<joint_count>::Constant(side * std::numeric_limits<double>::infinity());
  }

  JointArray<JerkMotion<7>, joint_count> motions_{};
  JointVector<joint_count> lower_ = everywhere(-1), upper_ = everywhere(1);  ///< of all samples
  /// The motion's own time per time, at most 1
  JointVector<joint_count> pace_ = JointVector<joint_count>::Ones();
  JointVector<joint_count> effort_ = JointVector<joint_count>::Zero();
  double duration_ = 0;
};

}  // namespace articula
