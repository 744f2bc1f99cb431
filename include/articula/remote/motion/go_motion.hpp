// SPDX-License-Identifier: Apache-2.0
/// @file The motion from any reference to rest at given positions.
#pragma once

#include "articula/reference/jerk_limited_profile.hpp"
#include "articula/reference/joint_stops.hpp"
#include "articula/reference/state_to_state_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace articula::remote {

/// The motion of a reference to rest at given positions, within limits, from rest or in mid-motion:
///
/// - From rest it is a JerkLimitedProfile.
/// - In mid-motion it is a StateToStateProfile, so that a slider that is dragged makes one motion.
/// - In mid-motion it is a stop and then a JerkLimitedProfile if there is no StateToStateProfile
///   within the limits. So it is, too, if the robot has more than `most_blended` joints, since the
///   search then takes long.
/// - No velocity is above what the joint can sustain: four fifths of its effort limit E hold
///   (0.8 E - f) / d against damping d and friction f. The rest is for acceleration and gravity.
template <Robot R>
class GoMotion {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr int most_blended = 10;  ///< joints; the search takes some 10 us for each
  using Vector = JointVector<joint_count>;
  using Reference = JointReference<joint_count>;
  using Limits = MotionLimits<joint_count>;

  /// @param limits  that validate() accepts
  GoMotion(const R& robot, const Limits& limits) noexcept
      : limits_(limits),
        sustained_(sustained(robot)),
        range_(joint_range(robot)),
        allowed_(range_),
        stop_(robot, Vector::Zero(), limits),
        profile_(JerkLimitedProfile<R>::move(Vector::Zero(), Vector::Zero(), limits)) {}

  /// Begins a motion.
  /// @param from    the present reference, finite
  /// @param target  within the joints' limits [rad or m], N x 1; a joint whose number is not finite
  ///                rests as soon as it can
  /// @param speed   share of the velocity limits, 0 < speed <= 1
  /// Real-time: yes. O(N), O(N^2) in mid-motion.
  void begin(const Reference& from, const Vector& target, double speed) noexcept {
    const Limits limits{(speed * limits_.velocity).cwiseMin(sustained_), limits_.acceleration,
                        limits_.jerk};
    allowed_ = range_.extended_to(from.position);
    stop_.begin(from);
    target_ = stop_.end();
    for (int j = 0; j < joint_count; ++j) {
      if (is_finite(target[j])) target_[j] = target[j];
    }
    time_ = 0;
    blend_.reset();
    pending_.reset();
    if (from.velocity.isZero(0) && from.acceleration.isZero(0)) {
      profile_ = JerkLimitedProfile<R>::move(from.position, target_, limits, from.effort);
      return;
    }
    if constexpr (joint_count <= most_blended) {
      blend_ = StateToStateProfile<R>::plan(from, {.position = target_, .effort = from.effort},
                                            both_ways(limits));
      if (blend_ && keeps_range(from) && keeps_velocity(from)) return;
      blend_.reset();
    }
    pending_ = limits;
  }

  /// Moves on by a period [s], > 0. Real-time: yes. O(N).
  /// @return the reference at its end
  [[nodiscard]] Reference advance(double period) noexcept {
    time_ += period;
    if (pending_) {
      const Reference stopping = stop_.advance(period);
      if (stop_.moves()) return stopping;
      profile_ =
          JerkLimitedProfile<R>::move(stopping.position, target_, *pending_, stopping.effort);
      pending_.reset();
      time_ = 0;
      return stopping;
    }
    if (!blend_ || time_ >= blend_->duration()) {
      if (blend_) {
        const JointVector<joint_count> effort = blend_->sample(time_).effort;
        return {.position = target_, .effort = effort};
      }
      return profile_.sample(time_);
    }
    Reference reference = blend_->sample(time_);
    reference.position = allowed_.clamp(reference.position);  // rounding
    return reference;
  }

  /// Whether the target is not reached yet. Real-time: yes.
  [[nodiscard]] bool moves() const noexcept {
    if (pending_) return true;
    return time_ < (blend_ ? blend_->duration() : profile_.duration());
  }
  /// Where it leads [rad or m], N x 1. Real-time: yes.
  [[nodiscard]] const Vector& target() const noexcept { return target_; }

 private:
  /// The velocities that the joints can sustain [rad/s or m/s], N x 1; infinity: any.
  [[nodiscard]] static Vector sustained(const R& robot) noexcept {
    return joint_values(robot, [](const JointProperties& joint) noexcept {
      const double velocity = (0.8 * joint.limits.effort - joint.friction) / joint.damping;
      return velocity > 0 ? velocity : std::numeric_limits<double>::infinity();
    });
  }

  /// Whether no joint exceeds its velocity limit while its acceleration fades. Trajectories may
  /// have accelerated harder. A stop then drops the acceleration.
  [[nodiscard]] bool keeps_velocity(const Reference& from) const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      const double v = from.velocity[j], a = from.acceleration[j];
      const double peak = std::abs(v) + a * a / (2 * limits_.jerk[j]);
      if (v * a > 0 && peak > limits_.velocity[j] * (1 + 1e-9)) return false;  // rounding
    }
    return true;
  }

  /// Whether the motion in between stays within the joints' limits.
  [[nodiscard]] bool keeps_range(const Reference& from) const noexcept {
    constexpr double rounding = 1e-9;  // [rad or m]
    for (int j = 0; j < joint_count; ++j) {
      const ValueRange allowed =
          ValueRange{range_.lower[j], range_.upper[j]}.extended_to(from.position[j]);
      const ValueRange positions = blend_->positions(j);
      if (positions.lowest < allowed.lowest - rounding) return false;
      if (positions.highest > allowed.highest + rounding) return false;
    }
    return true;
  }

  Limits limits_;
  Vector sustained_;
  JointRange<joint_count> range_;
  JointRange<joint_count> allowed_;  ///< by the limits and the beginning
  JointStops<R> stop_;
  JerkLimitedProfile<R> profile_;
  std::optional<StateToStateProfile<R>> blend_{};
  std::optional<Limits> pending_{};  ///< of the profile after the stop
  Vector target_ = Vector::Zero();
  double time_ = 0;
};

}  // namespace articula::remote
