// SPDX-License-Identifier: Apache-2.0
/// @file The positions that the joints of a robot can have.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <numbers>
#include <string_view>

namespace articula {

/// The positions that N joints can have.
template <int N>
struct JointRange {
  JointVector<N> lower, upper;  ///< limits of the position [rad or m], N x 1
  JointVector<N> turn;          ///< 2 pi for continuous joints, 0 for others [rad], N x 1

  /// The range with a position outside it, if it is outside, and a margin on both sides [rad or m].
  /// Real-time: yes. O(N).
  [[nodiscard]] JointRange extended_to(const JointVector<N>& position,
                                       double margin = 0) const noexcept {
    JointRange range = *this;
    for (int j = 0; j < N; ++j) {
      range.lower[j] = std::min(lower[j], position[j]) - margin;
      range.upper[j] = std::max(upper[j], position[j]) + margin;
    }
    return range;
  }
  /// The position within the range that is next to another one [rad or m], N x 1.
  /// Real-time: yes. O(N).
  [[nodiscard]] JointVector<N> clamp(const JointVector<N>& position) const noexcept {
    return for_each_joint<N>(
        [&](int j) noexcept { return std::min(std::max(position[j], lower[j]), upper[j]); });
  }
};

/// The range in a robot's description. Real-time: yes.
template <Robot R>
[[nodiscard]] JointRange<joint_count<R>> joint_range(const R& robot) noexcept {
  return {joint_values(robot, [](const auto& joint) { return joint.limits.lower; }),
          joint_values(robot, [](const auto& joint) { return joint.limits.upper; }),
          joint_values(robot, [](const auto& joint) {
            return joint.type == JointType::continuous ? 2 * std::numbers::pi : 0;
          })};
}

namespace detail {

/// Checks that positions are finite and within the limits of a robot's joints.
/// @param subject   the beginning of the message
/// @param position  [rad or m], N x 1
/// @throws std::invalid_argument naming joint, value and limits
template <Robot R>
void check_positions(const R& robot, std::string_view subject,
                     const JointVector<joint_count<R>>& position) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    if (!is_finite(position[j])) {
      refuse({subject, ": position ", position[j], " of joint '", joint.name.view(),
              "' is not a finite number"});
    }
    if (position[j] < joint.limits.lower || position[j] > joint.limits.upper) {
      refuse({subject, ": position ", position[j], " of joint '", joint.name.view(),
              "' is outside its limits ", joint.limits.lower, " .. ", joint.limits.upper});
    }
  }
}

}  // namespace detail
}  // namespace articula
