// SPDX-License-Identifier: Apache-2.0
/// @file A constant reference.
#pragma once

#include "articula/reference/joint_range.hpp"

namespace articula {

/// A constant position: v_ref = a_ref = 0, and no feed-forward effort.
template <Robot R>
class SetPoint {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param position  q_ref [rad or m], N x 1
  /// @throws std::invalid_argument if a position is not finite or outside the joint's limits
  SetPoint(const R& robot, const JointVector<joint_count>& position) {
    detail::check_positions(robot, "set-point", position);
    reference_.position = position;
  }
  /// For a robot known at compile time.
  explicit SetPoint(const JointVector<joint_count>& position)
    requires DescribedRobot<R>
      : SetPoint(R(), position) {}

  /// The reference, equal at all times. Real-time: yes.
  [[nodiscard]] JointReference<joint_count> sample(double /*time*/) const noexcept {
    return reference_;
  }

 private:
  JointReference<joint_count> reference_{};
};

}  // namespace articula
