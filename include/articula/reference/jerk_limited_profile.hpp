// SPDX-License-Identifier: Apache-2.0
/// @file Motions from point to point, and stops, within limits of velocity, acceleration and jerk.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/motion/jerk_motion.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/motion/stop_within.hpp"
#include "articula/reference/checks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace articula {

/// A motion of all joints to rest, as a function of the time since it began.
///
///     JerkLimitedProfile<Q2d> profile({0, 0}, {-1, 1}, limits);
///     loop.reference() = profile.sample(loop.next_time());
///
/// From rest to rest, each joint would take the least time that its limits allow (rest_to_rest);
/// all take as long as the slowest. The others' motion is stretched in time by a factor s, which
/// divides their velocities by s, accelerations by s^2 and jerks by s^3. A stop is the fastest of
/// each joint alone (fastest_stop). Every sample keeps the limits to the last bit; only a stop that
/// is to stay within a range may be harder.
/// @tparam R  the robot
template <Robot R>
class JerkLimitedProfile {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Limits = MotionLimits<joint_count>;

  /// From rest to rest.
  /// @param robot   whose joints these are
  /// @param from    where it begins [rad or m], N x 1; may be beyond the joints' limits, so that
  ///                there is a way back
  /// @param to      where it ends [rad or m], N x 1
  /// @param limits  V, A, J
  /// @throws std::invalid_argument if a limit is out of range, a position is not finite, `to` is
  ///         beyond a joint's limits, or a joint is so slow that it would never arrive; the message
  ///         names joint, value and limit
  JerkLimitedProfile(const R& robot, const JointVector<joint_count>& from,
                     const JointVector<joint_count>& to, const Limits& limits) {
    validate(robot, limits);
    detail::check_positions(robot, "profile", to);
    *this = move(from, to, limits);
    for (int j = 0; j < joint_count; ++j) {
      if (is_finite(from[j]) && is_finite(duration_)) continue;
      detail::refuse({"profile: from ", from[j], " to ", to[j], " joint '",
                      joint_names(robot)[static_cast<std::size_t>(j)], "' never arrives"});
    }
  }
  /// For a robot known at compile time.
  JerkLimitedProfile(const JointVector<joint_count>& from, const JointVector<joint_count>& to,
                     const Limits& limits)
    requires DescribedRobot<R>
      : JerkLimitedProfile(R(), from, to, limits) {}

  /// From rest to rest, as the constructor does, for numbers known to be good.
  /// @param limits  that validate() accepts
  /// @param effort  feed-forward on the way and after it [N m or N], N x 1
  /// Real-time: yes. O(N).
  [[nodiscard]] static JerkLimitedProfile move(
      const JointVector<joint_count>& from, const JointVector<joint_count>& to,
      const Limits& limits,
      const JointVector<joint_count>& effort = JointVector<joint_count>::Zero()) noexcept {
    JerkLimitedProfile profile;
    profile.effort_ = effort;
    profile.lower_ = from.cwiseMin(to);
    profile.upper_ = from.cwiseMax(to);
    for (int j = 0; j < joint_count; ++j) {
      JerkMotion& motion = profile.motions_[static_cast<std::size_t>(j)];
      motion =
          rest_to_rest(from[j], to[j], limits.velocity[j], limits.acceleration[j], limits.jerk[j]);
      profile.duration_ = std::max(profile.duration_, motion.duration());
    }
    for (int j = 0; j < joint_count; ++j) {
      const double own = profile.motions_[static_cast<std::size_t>(j)].duration();
      profile.pace_[j] = own < profile.duration_ ? own / profile.duration_ : 1;
    }
    return profile;
  }

  /// The fastest stop, wherever that is, or within a range (stop_within). What the reference asked
  /// for is where it begins: position and velocity go on without a jump, and so does an
  /// acceleration that can fade without leading beyond V. The reference's effort stays as it is,
  /// for it may be what carries the robot. A velocity beyond V only falls.
  /// @param from    what the joints were last asked for
  /// @param limits  that validate() accepts
  /// @param lower   where the joints can be [rad or m], N x 1; for a joint whose fastest stop leads
  /// @param upper   out of there, acceleration and jerk are as much higher as it takes
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
      JerkMotion& motion = profile.motions_[static_cast<std::size_t>(j)];
      motion = stop_within({from.position[j], from.velocity[j], from.acceleration[j]},
                           limits.velocity[j], limits.acceleration[j], limits.jerk[j], lower[j],
                           upper[j]);
      profile.duration_ = std::max(profile.duration_, motion.duration());
    }
    return profile;
  }

  /// When all joints rest [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return duration_; }

  /// The reference at a time since the start [s]; before 0 as at 0, from duration() on at rest. A
  /// time that is not finite gives NaN, which a loop refuses.
  /// Real-time: yes. O(N).
  [[nodiscard]] Reference sample(double time) const noexcept {
    Reference reference;
    reference.effort = effort_;
    if (!is_finite(time)) {
      reference.position.setConstant(std::numeric_limits<double>::quiet_NaN());
      return reference;
    }
    for (int j = 0; j < joint_count; ++j) {
      const JerkMotion& joint = motions_[static_cast<std::size_t>(j)];
      const double own_time = time < duration_ ? std::max(0.0, time * pace_[j]) : duration_;
      const JointMotion motion = joint.sample(own_time);
      reference.position[j] =
          std::min(std::max(motion.position, lower_[j]), upper_[j]);  // rounding
      reference.velocity[j] = motion.velocity * pace_[j];
      reference.acceleration[j] = motion.acceleration * pace_[j] * pace_[j];
    }
    return reference;
  }

 private:
  JerkLimitedProfile() = default;

  [[nodiscard]] static JointVector<joint_count> everywhere(double side) noexcept {
    return JointVector<joint_count>::Constant(side * std::numeric_limits<double>::infinity());
  }

  std::array<JerkMotion, static_cast<std::size_t>(joint_count)> motions_{};
  JointVector<joint_count> lower_ = everywhere(-1), upper_ = everywhere(1);  ///< of all samples
  JointVector<joint_count> pace_ = JointVector<joint_count>::Ones();  ///< own time per time, <= 1
  JointVector<joint_count> effort_ = JointVector<joint_count>::Zero();
  double duration_ = 0;
};

}  // namespace articula
