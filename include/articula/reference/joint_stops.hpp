// SPDX-License-Identifier: Apache-2.0
/// @file Stops of joints from any motion, and their motions back to given positions.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/motion/fastest_stop.hpp"
#include "articula/motion/motion_limits.hpp"
#include "articula/motion/rest_to_rest.hpp"
#include "articula/reference/joint_range.hpp"

#include <algorithm>
#include <limits>

namespace articula {

/// The fastest stop of each joint from any motion, followed by the fastest motion from rest to a
/// given position. Each joint stops and returns as if it were alone. Joints that start within their
/// position limits stay there. Where the fastest stop would leave them, acceleration and jerk
/// exceed their limits as little as possible (stop_within). The reference's effort stays. All
/// functions are real-time.
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

  /// At rest.
  /// @param position  finite [rad or m], N x 1
  /// @param limits    that validate() accepts
  JointStops(const R& robot, const Vector& position,
             const MotionLimits<joint_count>& limits) noexcept
      : limits_(limits), range_(joint_range(robot)), allowed_(range_.extended_to(position)) {
    for (int j = 0; j < joint_count; ++j) motions_[j] = JerkMotion<7>({position[j], 0, 0});
  }

  /// Begins the stops of some joints. Those of others go on.
  /// @param from  the present reference
  /// @param back  where the joints go after their stop [rad or m], N x 1. A joint whose number is
  ///              not finite stays where its stop ends. The number is clamped to the joint's limits
  ///              or the present position, whichever is further out.
  void begin(const Joints& joints, const Reference& from, const Vector& back = nowhere()) noexcept {
    begin(joints, from, back, range_);
  }
  /// The same with other limits of positions for the stops.
  /// @param range  within the joints' limits
  void begin(const Joints& joints, const Reference& from, const Vector& back,
             const JointRange<joint_count>& range) noexcept {
    const JointRange<joint_count> reachable = range_.extended_to(from.position);
    const Vector target = reachable.clamp(back);
    for (int j = 0; j < joint_count; ++j) {
      if (!joints[j]) continue;
      const double lower = range.lower[j], upper = range.upper[j];
      constexpr double infinity = std::numeric_limits<double>::infinity();
      allowed_.lower[j] = from.position[j] >= lower ? lower : -infinity;
      allowed_.upper[j] = from.position[j] <= upper ? upper : infinity;
      motions_[j] = stop_within(motion_of(from, j), limits_.velocity[j], limits_.acceleration[j],
                                limits_.jerk[j], lower, upper);
      time_[j] = 0;
      effort_[j] = from.effort[j];
      back_[j] = nowhere()[j];
      if (is_finite(back[j]) && target[j] != motions_[j].end().position) back_[j] = target[j];
    }
  }
  /// The same of all joints.
  void begin(const Reference& from, const Vector& back = nowhere()) noexcept {
    Joints all;
    all.fill(true);
    begin(all, from, back);
  }

  /// Lets a period [s] pass, >= 0.
  void pass(double period) noexcept {
    for (int j = 0; j < joint_count; ++j) {
      time_[j] += period;
      if (time_[j] < motions_[j].duration() || !is_finite(back_[j])) continue;
      time_[j] -= motions_[j].duration();
      return_from(sample(j, motions_[j].duration()).position, j);
    }
  }
  /// The present reference.
  [[nodiscard]] Reference reference() const noexcept {
    Reference reference{.effort = effort_};
    for (int j = 0; j < joint_count; ++j) {
      set_motion(reference, j, sample(j, std::min(time_[j], motions_[j].duration())));
    }
    return reference;
  }
  /// Lets a period pass, and returns the reference at its end.
  [[nodiscard]] Reference advance(double period) noexcept {
    pass(period);
    return reference();
  }

  /// The limits of the joints' positions.
  [[nodiscard]] const JointRange<joint_count>& range() const noexcept { return range_; }

  /// Where each joint rests after its present motion, a stop or a return [rad or m], N x 1.
  [[nodiscard]] Vector end() const noexcept {
    return for_each_joint<joint_count>(
        [&](int j) noexcept { return sample(j, motions_[j].duration()).position; });
  }
  /// Whether a joint moves, or will move back.
  [[nodiscard]] bool moves(int joint) const noexcept {
    return is_finite(back_[joint]) || time_[joint] < motions_[joint].duration();
  }
  /// Whether any joint does.
  [[nodiscard]] bool moves() const noexcept {
    for (int j = 0; j < joint_count; ++j) {
      if (moves(j)) return true;
    }
    return false;
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
    back_[j] = nowhere()[j];
  }

  MotionLimits<joint_count> limits_;
  JointRange<joint_count> range_;
  JointRange<joint_count> allowed_;  ///< of all samples
  JointArray<JerkMotion<7>, joint_count> motions_{};
  Vector time_ = Vector::Zero();  ///< since the beginning of the motion [s]
  Vector effort_ = Vector::Zero();
  Vector back_ = nowhere();  ///< of joints that will return
};

}  // namespace articula
