// SPDX-License-Identifier: Apache-2.0
/// @file A reference that does not move.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/model/robot.hpp"
#include "articula/reference/checks.hpp"

namespace articula {

/// One position for all times: q_ref constant, v_ref = a_ref = 0, and no feed-forward effort.
/// @tparam R  the robot
template <Robot R>
class SetPoint {
 public:
  static constexpr int joint_count = articula::joint_count<R>;

  /// @param robot     whose joints these are
  /// @param position  q_ref [rad or m], N x 1
  /// @throws std::invalid_argument if a position is not finite or beyond the joint's limits
  SetPoint(const R& robot, const JointVector<joint_count>& position) {
    detail::check_positions(robot, "set-point", position);
    reference_.position = position;
  }
  /// For a robot known at compile time.
  explicit SetPoint(const JointVector<joint_count>& position)
    requires DescribedRobot<R>
      : SetPoint(R(), position) {}

  /// The same at any time. Real-time: yes.
  [[nodiscard]] JointReference<joint_count> sample(double /*time*/) const noexcept {
    return reference_;
  }

 private:
  JointReference<joint_count> reference_{};
};

}  // namespace articula
