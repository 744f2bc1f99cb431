// SPDX-License-Identifier: Apache-2.0
/// @file A stop from any motion, and the motion back to a given position.
#pragma once

#include "articula/reference/jerk_limited_profile.hpp"
#include "articula/reference/joint_range.hpp"

#include <limits>
#include <optional>

namespace articula {

/// The fastest stop from any motion, followed by a motion from rest to a given position. If the
/// joints start within their position limits, they stay there. Where the fastest stop would leave
/// them, acceleration and jerk exceed their limits as little as possible (stop_within). The
/// reference's effort stays.
template <Robot R>
class StopAndReturn {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Position = JointVector<joint_count>;

  /// No final position for any joint: NaN, N x 1. Real-time: yes.
  [[nodiscard]] static Position unknown() noexcept {
    return Position::Constant(std::numeric_limits<double>::quiet_NaN());
  }

  /// At rest.
  /// @param position  finite [rad or m], N x 1
  /// @param limits    that validate() accepts
  /// Real-time: yes.
  StopAndReturn(const R& robot, const Position& position,
                const MotionLimits<joint_count>& limits) noexcept
      : limits_(limits),
        range_(joint_range(robot)),
        profile_(JerkLimitedProfile<R>::move(position, position, limits)) {}

  /// Begins a stop.
  /// @param from  the last reference of the joints
  /// @param back  final position [rad or m], N x 1; a joint whose number is not finite stays where
  ///              its stop ends. It is clamped to the joint's limits or the initial position,
  ///              whichever is further out
  /// Real-time: yes. O(N).
  void begin(const Reference& from, const Position& back = unknown()) noexcept {
    profile_ = JerkLimitedProfile<R>::stop(from, limits_, range_.lower, range_.upper);
    time_ = 0;
    const Position end = profile_.sample(profile_.duration()).position;
    target_ = back;
    Position wanted = end;
    for (int j = 0; j < joint_count; ++j) {
      if (is_finite(target_[j])) wanted[j] = target_[j];
    }
    const Position target = range_.extended_to(from.position).clamp(wanted);
    back_.reset();
    if (target != end) back_ = target;
  }

  /// Lets a period [s] pass, >= 0. Real-time: yes. O(N).
  void pass(double period) noexcept {
    time_ += period;
    if (back_ && time_ >= profile_.duration()) {
      time_ -= profile_.duration();
      const Reference here = profile_.sample(profile_.duration());
      profile_ = JerkLimitedProfile<R>::move(here.position, *back_, limits_, here.effort);
      back_.reset();
    }
  }
  /// The present reference. Real-time: yes. O(N).
  [[nodiscard]] Reference reference() const noexcept { return profile_.sample(time_); }
  /// Lets a period pass, and returns the reference at its end. Real-time: yes. O(N).
  [[nodiscard]] Reference advance(double period) noexcept {
    pass(period);
    return reference();
  }

  /// The final position that begin() received [rad or m], N x 1. Real-time: yes.
  [[nodiscard]] const Position& target() const noexcept { return target_; }

  /// Whether a joint still moves, or will move back. Real-time: yes.
  [[nodiscard]] bool moves() const noexcept { return back_ || time_ < profile_.duration(); }

 private:
  MotionLimits<joint_count> limits_;
  JointRange<joint_count> range_;
  JerkLimitedProfile<R> profile_;
  double time_ = 0;
  std::optional<Position> back_{};  ///< target of the motion after the stop
  Position target_ = unknown();
};

}  // namespace articula
