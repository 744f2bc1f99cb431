// SPDX-License-Identifier: Apache-2.0
/// @file Coming to rest from any motion, and where it should be.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/model/robot.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/reference/jerk_limited_profile.hpp"

#include <limits>
#include <optional>

namespace articula {

/// The fastest stop from any motion, and then the way back, if it does not end where it should.
/// From within the joints' limits of position neither leads out of them: where the fastest stop
/// would, it is harder than the limits of acceleration and jerk allow, by no more than it takes
/// (stop_within). The reference's effort stays.
/// @tparam R  the robot
template <Robot R>
class StopAndReturn {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Position = JointVector<joint_count>;

  /// At rest.
  /// @param position  finite [rad or m], N x 1
  /// @param limits    that validate() accepts
  /// Real-time: yes.
  StopAndReturn(const R& robot, const Position& position,
                const MotionLimits<joint_count>& limits) noexcept
      : limits_(limits),
        lower_(joint_values(robot, [](const auto& joint) { return joint.limits.lower; })),
        upper_(joint_values(robot, [](const auto& joint) { return joint.limits.upper; })),
        way_(JerkLimitedProfile<R>::move(position, position, limits)) {}

  /// Begins a stop.
  /// @param from  what the joints were last asked for
  /// @param back  where they should be in the end [rad or m], N x 1; where it is not given, or not
  ///              finite, where the stop ends. Either no further out than the limits of the joints,
  ///              or than it began
  /// Real-time: yes. O(N).
  void begin(const Reference& from, const std::optional<Position>& back = {}) noexcept {
    way_ = JerkLimitedProfile<R>::stop(from, limits_, lower_, upper_);
    time_ = 0;
    const Position end = way_.sample(way_.duration()).position;
    target_ = back.value_or(unknown());
    Position wanted = end;
    for (int j = 0; j < joint_count; ++j) {
      if (is_finite(target_[j])) wanted[j] = target_[j];
    }
    const Position target =
        wanted.cwiseMax(lower_.cwiseMin(from.position)).cwiseMin(upper_.cwiseMax(from.position));
    back_.reset();
    if (target != end) back_ = target;
  }

  /// Lets time pass.
  /// @param period  [s], >= 0
  /// @return        the reference then
  /// Real-time: yes. O(N).
  [[nodiscard]] Reference advance(double period) noexcept {
    time_ += period;
    if (back_ && time_ >= way_.duration()) {
      time_ -= way_.duration();
      const Reference here = way_.sample(way_.duration());
      way_ = JerkLimitedProfile<R>::move(here.position, *back_, limits_, here.effort);
      back_.reset();
    }
    return way_.sample(time_);
  }

  /// What begin() was given to go back to [rad or m], N x 1; not finite where nothing.
  /// Real-time: yes.
  [[nodiscard]] const Position& target() const noexcept { return target_; }

  /// Whether it is not yet at rest for good. Real-time: yes.
  [[nodiscard]] bool moves() const noexcept { return back_ || time_ < way_.duration(); }

 private:
  [[nodiscard]] static Position unknown() noexcept {
    return Position::Constant(std::numeric_limits<double>::quiet_NaN());
  }

  MotionLimits<joint_count> limits_;
  Position lower_, upper_;
  JerkLimitedProfile<R> way_;
  double time_ = 0;
  std::optional<Position> back_{};  ///< where to go after the stop
  Position target_ = unknown();
};

}  // namespace articula
