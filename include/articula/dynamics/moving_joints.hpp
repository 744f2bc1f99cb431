// SPDX-License-Identifier: Apache-2.0
/// @file All moving joints: those that can be commanded, and mimic joints.
#pragma once

#include "articula/dynamics/engine/coupling.hpp"
#include "articula/dynamics/engine/evaluate.hpp"

#include <string_view>

namespace articula {

/// The number of moving joints, including mimic joints.
template <Robot R>
inline constexpr int moving_joint_count =
    std::remove_cvref_t<decltype(model_of(std::declval<R>()))>::body_count;

/// The names of all moving joints, depth first, siblings by joint name.
/// Real-time: yes.
template <Robot R>
[[nodiscard]] constexpr auto moving_joint_names(const R& robot) noexcept {
  JointArray<std::string_view, moving_joint_count<R>> names;
  for (int i = 0; i < moving_joint_count<R>; ++i)
    names[i] = model_of(robot).moving_joints[i].view();
  return names;
}

/// The names refer to the model, so a temporary model is refused.
template <Robot R>
  requires(!DescribedRobot<R>)
auto moving_joint_names(const R&& robot) = delete;

/// The positions of all moving joints. A mimic joint is at q = multiplier q_of_the_other + offset.
/// @param robot  a described robot or a model
/// @param q      positions of the joints that can be commanded [rad or m], N x 1
/// @return       in the order of moving_joint_names [rad or m], moving_joint_count x 1
/// Real-time: yes.
template <Robot R>
[[nodiscard]] JointVector<moving_joint_count<R>> moving_joint_positions(
    const R& robot, const JointVector<joint_count<R>>& q) noexcept {
  return detail::to_vector(body_positions<double, joint_count<R>, moving_joint_count<R>>(
      model_of(robot).mechanism, detail::to_array(q)));
}

/// The velocities of all moving joints. A mimic joint has v = multiplier v_of_the_other. The same
/// holds for accelerations.
/// @param robot  a described robot or a model
/// @param v      velocities of the joints that can be commanded [rad/s or m/s], N x 1
/// @return       in the order of moving_joint_names [rad/s or m/s], moving_joint_count x 1
/// Real-time: yes.
template <Robot R>
[[nodiscard]] JointVector<moving_joint_count<R>> moving_joint_velocities(
    const R& robot, const JointVector<joint_count<R>>& v) noexcept {
  return detail::to_vector(body_rates<double, joint_count<R>, moving_joint_count<R>>(
      model_of(robot).mechanism, detail::to_array(v)));
}

}  // namespace articula
