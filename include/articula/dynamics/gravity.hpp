// SPDX-License-Identifier: Apache-2.0
/// @file The efforts that hold a robot against gravity.
#pragma once

#include "articula/dynamics/engine/evaluate.hpp"
#include "articula/dynamics/engine/gravity_efforts.hpp"

namespace articula {

/// The joint efforts that hold the robot still against gravity: g(q), the gradient of the potential
/// energy.
/// @param robot  a described robot or a model; gravity is the robot's own
/// @param q      joint positions [rad or m], N x 1
/// @return       joint efforts [N m or N], N x 1
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> gravity(const R& robot,
                                                  const JointVector<joint_count<R>>& q) noexcept {
  return detail::to_vector(detail::evaluate<Gravity>(robot, q));
}

/// The same for several robots of one kind at once, see JointVectorPack. Real-time: yes.
template <Robot R, JointVectorPack<R> Q>
[[nodiscard]] Q gravity(const R& robot, const Q& q) noexcept {
  return detail::evaluate_pack<Gravity>(robot, q);
}

}  // namespace articula
