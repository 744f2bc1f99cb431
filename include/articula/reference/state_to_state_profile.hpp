// SPDX-License-Identifier: Apache-2.0
/// @file Motions of all joints from any state to any other, within limits of each direction.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"
#include "articula/motion/motion_bounds.hpp"
#include "articula/motion/state_to_state_motion.hpp"
#include "articula/motion/timed_motion.hpp"
#include "articula/reference/checks.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace articula {

/// The least duration that all joints can take together [s]: at least a given one, and in no
/// joint's gap (StateToStateMotion::can_take). Infinity if a joint has no motion.
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

/// A motion of all joints from one state to another, either of which may move and accelerate, as a
/// function of the time since it began:
///
///     StateToStateProfile<Q2d> profile(loop.reference(), {.position = {-1, 1}}, both_ways(limits));
///     loop.reference() = profile.sample(time);
///
/// It is the fastest motion in which all joints arrive together (StateToStateMotion,
/// common_duration), or takes a duration that is asked for. After the end it goes on with the
/// velocity and the acceleration of the target: a target that moves is passed, not held. Where both
/// states are at rest, JerkLimitedProfile does the same with less computation.
/// @tparam R  the robot
template <Robot R>
class StateToStateProfile {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Limits = DirectedLimits<joint_count>;

  /// @param from     where it begins; may be beyond the limits, so that there is a way back
  /// @param to       where it ends; the feed-forward effort goes there linearly
  /// @param limits   of each joint
  /// @param minimum  least duration [s]
  /// @throws std::invalid_argument if a limit is out of range, a figure is not finite, `to` is
  ///         beyond a limit or cannot be arrived at within them, the minimum is negative, or a
  ///         joint passes its limits of position on the way; the message names joint, value, limit
  StateToStateProfile(const R& robot, const Reference& from, const Reference& to,
                      const Limits& limits, double minimum = 0) {
    validate(robot, limits);
    detail::check_positions(robot, "profile", to.position);
    if (!is_finite(minimum) || minimum < 0) {
      detail::refuse({"profile: minimum duration ", minimum, " s is not a number >= 0"});
    }
    if (!is_finite(from) || !is_finite(to)) {
      detail::refuse({"profile: start or target has a figure that is not finite"});
    }
    const auto found = plan(from, to, limits, minimum);
    if (found) *this = *found;
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
      const JointMotion target{to.position[j], to.velocity[j], to.acceleration[j]};
      if (!StateToStateMotion::can_be_arrived_at(target, limits.of(j))) {
        detail::refuse({"profile: target velocity ", to.velocity[j], " and acceleration ",
                        to.acceleration[j], " of joint '", joint.name.view(),
                        "' are not within its motion limits, or cannot be arrived at within them"});
      }
      if (!motion_of(from, to, limits, j).exists()) {
        detail::refuse({"profile: no motion was found for joint '", joint.name.view(), "' from ",
                        from.position[j], " with velocity ", from.velocity[j], " to ",
                        to.position[j], " with velocity ", to.velocity[j]});
      }
      if (!found) continue;
      const PositionRange way = motions_[static_cast<std::size_t>(j)].positions();
      constexpr double rounding = 1e-9;  // [rad or m]
      const bool below = way.lowest < std::min(joint.limits.lower, from.position[j]) - rounding;
      if (!below && way.highest <= std::max(joint.limits.upper, from.position[j]) + rounding) {
        continue;
      }
      detail::refuse({"profile: on its way joint '", joint.name.view(), "' swings out to ",
                      below ? way.lowest : way.highest, ", outside its limits ", joint.limits.lower,
                      " .. ", joint.limits.upper});
    }
    if (!found) {
      detail::refuse(
          {"profile: no motion was found in which all joints arrive together and keep "
           "their limits"});
    }
  }
  /// For a robot known at compile time.
  StateToStateProfile(const Reference& from, const Reference& to, const Limits& limits,
                      double minimum = 0)
    requires DescribedRobot<R>
      : StateToStateProfile(R(), from, to, limits, minimum) {}

  /// The same for the control loop: the limits are known to be good, and positions on the way are
  /// not compared with the joints' limits.
  /// @return nothing if a figure is not finite, a target cannot be arrived at, or no motion was
  ///         found that keeps the limits
  /// Real-time: yes. O(N^2) in the worst case; some 10 us for each joint.
  [[nodiscard]] static std::optional<StateToStateProfile> plan(const Reference& from,
                                                               const Reference& to,
                                                               const Limits& limits,
                                                               double minimum = 0) noexcept {
    if (!is_finite(from) || !is_finite(to)) return std::nullopt;
    std::array<StateToStateMotion, static_cast<std::size_t>(joint_count)> joints;
    for (int j = 0; j < joint_count; ++j) {
      joints[static_cast<std::size_t>(j)] = motion_of(from, to, limits, j);
    }
    StateToStateProfile profile;
    profile.duration_ = common_duration(joints, minimum);
    if (!is_finite(profile.duration_)) return std::nullopt;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      profile.motions_[j] = joints[j].motion(profile.duration_);
      if (!profile.motions_[j].keeps(limits.of(static_cast<int>(j)))) return std::nullopt;
    }
    profile.from_effort_ = from.effort;
    profile.to_effort_ = to.effort;
    return profile;
  }

  /// When all joints arrive [s]. Real-time: yes.
  [[nodiscard]] double duration() const noexcept { return duration_; }

  /// The reference at a time since the start [s]; before 0 as at 0. A time that is not finite gives
  /// NaN, which a loop refuses.
  /// Real-time: yes. O(N).
  [[nodiscard]] Reference sample(double time) const noexcept {
    Reference reference;
    if (!is_finite(time)) {
      reference.position.setConstant(std::numeric_limits<double>::quiet_NaN());
      return reference;
    }
    for (int j = 0; j < joint_count; ++j) {
      const JointMotion now = motions_[static_cast<std::size_t>(j)].sample(time);
      reference.position[j] = now.position;
      reference.velocity[j] = now.velocity;
      reference.acceleration[j] = now.acceleration;
    }
    const double share = duration_ > 0 ? std::clamp(time / duration_, 0.0, 1.0) : 1;
    reference.effort = from_effort_ + share * (to_effort_ - from_effort_);
    return reference;
  }

 private:
  StateToStateProfile() = default;

  [[nodiscard]] static StateToStateMotion motion_of(const Reference& from, const Reference& to,
                                                    const Limits& limits, int j) noexcept {
    return {{from.position[j], from.velocity[j], from.acceleration[j]},
            {to.position[j], to.velocity[j], to.acceleration[j]},
            limits.of(j)};
  }

  std::array<TimedMotion, static_cast<std::size_t>(joint_count)> motions_{};
  JointVector<joint_count> from_effort_ = JointVector<joint_count>::Zero();
  JointVector<joint_count> to_effort_ = JointVector<joint_count>::Zero();
  double duration_ = 0;
};

}  // namespace articula
