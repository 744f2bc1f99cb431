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

  /// @param position  q_ref [rad or m], N x 1
  /// @throws std::invalid_argument if a position is not finite or beyond the joint's limits
  explicit SetPoint(const JointVector<joint_count>& position, const R& robot = described<R>()) {
    detail::check_positions("set-point", position, robot);
    reference_.position = position;
  }

  /// The same at any time. Real-time: yes.
  [[nodiscard]] JointReference<joint_count> sample(double /*time*/) const noexcept {
    return reference_;
  }

 private:
  JointReference<joint_count> reference_{};
};

}  // namespace articula
