// SPDX-License-Identifier: Apache-2.0
/// @file Several varied robots in the lanes of a pack.
#pragma once

#include "articula/core/scalar.hpp"
#include "articula/dynamics/varied_robot.hpp"

#include <array>
#include <cstddef>

namespace articula {

/// The limits of a joint and its drive, with the numbers of several robots. See JointLimits.
template <PackedScalar S>
struct LimitLanes {
  S lower = -JointLimits::infinity;
  S upper = JointLimits::infinity;
  S velocity = JointLimits::infinity;
  S effort = JointLimits::infinity;
};

/// The properties of a joint, with the numbers of several robots. See JointProperties.
template <PackedScalar S>
struct JointLanes {
  LimitLanes<S> limits{};
  S damping = 0;
  S friction = 0;
};

/// Varied robots of one kind, one in each lane. The algorithms of dynamics take it in place of R
/// for vectors over S, and compute each lane's robot with its own numbers.
/// @tparam R  the kind
/// @tparam S  a pack
template <DescribedRobot R, PackedScalar S>
class RobotLanes {
 public:
  using Nominal = R;
  static constexpr int joint_count = articula::joint_count<R>;
  static constexpr int body_count = VariedRobot<R>::body_count;
  static constexpr bool kinematic = false;
  static constexpr const auto& mechanism = detail::compiled_model<R>.mechanism;  ///< the tree's

  /// The described robot in all lanes.
  RobotLanes() {
    const VariedRobot<R> nominal;
    for (int k = 0; k < lanes<S>; ++k) set(k, nominal);
  }

  /// Puts a robot into a lane. Real-time: yes.
  void set(int lane, const VariedRobot<R>& robot) noexcept {
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      set_lane(numbers_[i], lane, robot.numbers()[i]);
    }
    for (int j = 0; j < joint_count; ++j) {
      const JointProperties& own = robot.joints[j];
      set_lane(joints[j].limits.lower, lane, own.limits.lower);
      set_lane(joints[j].limits.upper, lane, own.limits.upper);
      set_lane(joints[j].limits.velocity, lane, own.limits.velocity);
      set_lane(joints[j].limits.effort, lane, own.limits.effort);
      set_lane(joints[j].damping, lane, own.damping);
      set_lane(joints[j].friction, lane, own.friction);
    }
  }

  /// The numbers that are inputs of the programs, as those of VariedRobot.
  [[nodiscard]] const std::array<S, std::size_t{VariedRobot<R>::number_count}>& numbers()
      const noexcept {
    return numbers_;
  }

  JointArray<JointLanes<S>, joint_count> joints{};

 private:
  std::array<S, std::size_t{VariedRobot<R>::number_count}> numbers_;
};

namespace detail {

template <DescribedRobot R, class S>
inline constexpr bool is_model<RobotLanes<R, S>> = true;

}  // namespace detail

}  // namespace articula
