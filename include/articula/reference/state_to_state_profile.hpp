// SPDX-License-Identifier: Apache-2.0
/// @file Motions of all joints from any state to any other, with limits of each direction.
#pragma once

#include "articula/motion/state_to_state_motion.hpp"
#include "articula/reference/joint_range.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace articula {

/// The least duration that the motions of all joints can take together [s]: at least `minimum`, and
/// in no joint's gap (StateToStateMotion::can_take). Infinity if a joint has no motion.
/// Real-time: yes. O(N^2) in the worst case.
[[nodiscard]] inline double common_duration(std::span<const StateToStateMotion> joints,
                                            double minimum = 0) noexcept {
  double duration = minimum;
  for (const StateToStateMotion& joint : joints) {
    duration = std::max(duration, joint.least_duration());
  }
  for (std::size_t fits = 0, k = 0; fits < joints.size(); k = (k + 1) % joints.size()) {
    if (!is_finite(duration)) return std::numeric_limits<double>::infinity();
    if (joints[k].can_take(duration)) {
      ++fits;
    } else {
      duration = joints[k].next_duration(duration);
      fits = 0;
    }
  }
  return duration;
}

/// A motion of all joints from one state to another as a function of the time since its start. Both
/// states may have velocities and accelerations:
///
///     StateToStateProfile<Q2d> profile(loop.reference(), {.position = {-1, 1}},
///                                          both_ways(limits));
///     loop.reference() = profile.sample(time);
///
/// All joints arrive together, as fast as possible or after a given duration (StateToStateMotion,
/// common_duration). After the end, the reference goes on with the velocity and the acceleration of
/// the target. So the profile passes a moving target and does not hold it. If both states are at
/// rest, JerkLimitedProfile does the same with less computation.
template <Robot R>
class StateToStateProfile {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Limits = JointArray<MotionBounds, joint_count>;

  /// @param from     state at the start; may be outside the limits
  /// @param to       state at the end; the feed-forward effort changes linearly
  /// @param limits   of each joint
  /// @param minimum  least duration [s]
  /// @throws std::invalid_argument if a limit is out of range, a number is not finite or the
  ///         minimum is negative
  /// @throws std::invalid_argument if `to` is beyond a limit, or no motion within the limits can
  ///         end there
  /// @throws std::invalid_argument if a joint leaves its position limits in between; messages name
  ///         joint, value and limit where there is one
  StateToStateProfile(const R& robot, const Reference& from, const Reference& to,
                      const Limits& limits, double minimum = 0) {
    validate(robot, limits);
    detail::check_positions(robot, "profile", to.position);
    if (!is_finite(minimum) || minimum < 0) {
      detail::refuse({"profile: minimum duration ", minimum, " s is not a number >= 0"});
    }
    if (!is_finite(from) || !is_finite(to)) {
      detail::refuse({"profile: start or target has a number that is not finite"});
    }
    for (int j = 0; j < joint_count; ++j) {
      if (StateToStateMotion(motion_of(from, j), motion_of(to, j), limits[j]).exists()) continue;
      detail::refuse({"profile: joint '", model_of(robot).joints[j].name.view(),
                      "' has no motion within its limits to the target velocity ", to.velocity[j],
                      " and acceleration ", to.acceleration[j]});
    }
    const auto found = plan(from, to, limits, minimum);
    if (!found) detail::refuse({"profile: the joints have no common duration within their limits"});
    *this = *found;
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& joint = model_of(robot).joints[j];
      constexpr double rounding = 1e-9;  // [rad or m]
      const ValueRange positions = motions_[j].positions();
      const bool below =
          positions.lowest < std::min(joint.limits.lower, from.position[j]) - rounding;
      if (!below &&
          positions.highest <= std::max(joint.limits.upper, from.position[j]) + rounding) {
        continue;
      }
      detail::refuse({"profile: between start and target joint '", joint.name.view(),
                      "' swings out to ", below ? positions.lowest : positions.highest,
                      ", outside its limits ", joint.limits.lower, " .. ", joint.limits.upper});
    }
  }
  /// For a robot known at compile time.
  StateToStateProfile(const Reference& from, const Reference& to, const Limits& limits,
                      double minimum = 0)
    requires DescribedRobot<R>
      : StateToStateProfile(R(), from, to, limits, minimum) {}

  /// The same for the control loop, without the checks of the constructor. Position limits are not
  /// checked.
  /// @param limits  that validate() accepts
  /// @return        nothing if a number is not finite, or no motion within the limits was found
  /// Real-time: yes. O(N^2) in the worst case; some 10 us for each joint.
  [[nodiscard]] static std::optional<StateToStateProfile> plan(const Reference& from,
                                                               const Reference& to,
                                                               const Limits& limits,
                                                               double minimum = 0) noexcept {
    if (!is_finite(from) || !is_finite(to)) return std::nullopt;
    JointArray<StateToStateMotion, joint_count> joints;
    for (int j = 0; j < joint_count; ++j) {
      joints[j] = StateToStateMotion(motion_of(from, j), motion_of(to, j), limits[j]);
    }
    StateToStateProfile profile;
    profile.duration_ = common_duration(joints, minimum);
    if (!is_finite(profile.duration_)) return std::nullopt;
    for (int j = 0; j < joint_count; ++j) {
      profile.motions_[j] = joints[j].motion(profile.duration_);
      if (!profile.motions_[j].keeps(limits[j])) return std::nullopt;
    }
    profile.from_effort_ = from.effort;
    profile.to_effort_ = to.effort;
    return profile;
  }

  /// The positions that a joint passes on its way [rad or m]. Real-time: yes.
  [[nodiscard]] ValueRange positions(int joint) const noexcept {
    return motions_[joint].positions();
  }

  /// The time at which all joints arrive [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return duration_; }

  /// The reference at a time since the start [s]; before 0 it is that at 0. A time that is not
  /// finite gives NaN. A loop refuses NaN.
  /// Real-time: yes. O(N).
  [[nodiscard]] Reference sample(double time) const noexcept {
    if (!is_finite(time)) return detail::undefined_reference<joint_count>();
    Reference reference;
    for (int j = 0; j < joint_count; ++j) set_motion(reference, j, motions_[j].sample(time));
    const double share = duration_ > 0 ? std::clamp(time / duration_, 0.0, 1.0) : 1;
    reference.effort = from_effort_ + share * (to_effort_ - from_effort_);
    return reference;
  }

 private:
  StateToStateProfile() = default;

  JointArray<TransferMotion, joint_count> motions_{};
  JointVector<joint_count> from_effort_ = JointVector<joint_count>::Zero();
  JointVector<joint_count> to_effort_ = JointVector<joint_count>::Zero();
  double duration_ = 0;
};

}  // namespace articula
