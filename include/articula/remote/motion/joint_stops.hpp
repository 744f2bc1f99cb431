// SPDX-License-Identifier: Apache-2.0
/// @file The stops of joints, each by itself.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/motion/fastest_stop.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/motion/rest_to_rest.hpp"
#include "articula/reference/joint_range.hpp"

#include <algorithm>
#include <limits>

namespace articula::remote {

/// The fastest stop of each joint (stop_within), and a motion from there to a given position. A joint
/// stops and returns as if it were alone, where StopAndReturn moves all joints together. The
/// reference's effort stays. In the loop's thread. All functions are real-time.
template <Robot R>
class JointStops {
 public:
  static constexpr int joint_count = articula::joint_count<R>;
  using Reference = JointReference<joint_count>;
  using Vector = JointVector<joint_count>;
  using Joints = JointArray<bool, joint_count>;

  /// No position to return to for any joint: NaN, N x 1.
  [[nodiscard]] static Vector nowhere() noexcept {
    return Vector::Constant(std::numeric_limits<double>::quiet_NaN());
  }

  /// @param limits  that validate() accepts
  JointStops(const R& robot, const MotionLimits<joint_count>& limits) noexcept
      : limits_(limits), range_(joint_range(robot)), allowed_(range_) {}

  /// Begins the stops of some joints. Those of others go on.
  /// @param from  the present reference
  /// @param back  where the joints go after their stop [rad or m], N x 1; NaN: they stay. It is
  ///              clamped to the joint's limits or the present position, whichever is further out.
  void begin(const Joints& joints, const Reference& from, const Vector& back = nowhere()) noexcept {
    const JointRange<joint_count> reachable = range_.extended_to(from.position);
    const Vector target = reachable.clamp(back);
    for (int j = 0; j < joint_count; ++j) {
      if (!joints[j]) continue;
      const double lower = range_.lower[j], upper = range_.upper[j];
      constexpr double infinity = std::numeric_limits<double>::infinity();
      allowed_.lower[j] = from.position[j] >= lower ? lower : -infinity;
      allowed_.upper[j] = from.position[j] <= upper ? upper : infinity;
      motions_[j] = stop_within(motion_of(from, j), limits_.velocity[j], limits_.acceleration[j],
                                limits_.jerk[j], lower, upper);
      time_[j] = 0;
      effort_[j] = from.effort[j];
      back_[j] = is_finite(back[j]) ? target[j] : back[j];
    }
  }

  /// Moves some joints on by a period [s].
  /// @param[out] reference  receives their reference at its end
  void advance(const Joints& joints, double period, Reference& reference) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (!joints[j]) continue;
      time_[j] += period;
      if (time_[j] >= motions_[j].duration() && is_finite(back_[j])) {
        time_[j] -= motions_[j].duration();
        return_from(sample(j, motions_[j].duration()).position, j);
      }
      set_motion(reference, j, sample(j, std::min(time_[j], motions_[j].duration())));
      reference.effort[j] = effort_[j];
    }
  }

  /// Whether a joint moves, or will move back.
  [[nodiscard]] bool moves(int joint) const noexcept {
    return is_finite(back_[joint]) || time_[joint] < motions_[joint].duration();
  }

 private:
  [[nodiscard]] JointMotion sample(int j, double time) const noexcept {
    JointMotion motion = motions_[j].sample(time);
    // The clamp removes rounding.
    motion.position = std::min(std::max(motion.position, allowed_.lower[j]), allowed_.upper[j]);
    return motion;
  }
  void return_from(double here, int j) noexcept {
    const double there = back_[j];
    motions_[j] =
        rest_to_rest(here, there, limits_.velocity[j], limits_.acceleration[j], limits_.jerk[j]);
    allowed_.lower[j] = std::min(here, there);
    allowed_.upper[j] = std::max(here, there);
    back_[j] = std::numeric_limits<double>::quiet_NaN();
  }

  MotionLimits<joint_count> limits_;
  JointRange<joint_count> range_;
  JointRange<joint_count> allowed_;  ///< of all samples
  JointArray<JerkMotion<7>, joint_count> motions_{};
  Vector time_ = Vector::Zero();  ///< since the beginning of the motion [s]
  Vector effort_ = Vector::Zero();
  Vector back_ = nowhere();
};

}  // namespace articula::remote
