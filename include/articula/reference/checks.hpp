// SPDX-License-Identifier: Apache-2.0
/// @file What the generators of references refuse at set-up, in one wording.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <string_view>

namespace articula::detail {

/// Positions that a robot can be asked for: finite and within the limits of the joints.
/// @param who       begins the message
/// @param position  [rad or m], N x 1
/// @throws std::invalid_argument naming joint, value and limits
template <Robot R>
void check_positions(const R& robot, std::string_view who,
                     const JointVector<joint_count<R>>& position) {
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(j)];
    if (!is_finite(position[j])) {
      refuse({who, ": position ", position[j], " of joint '", joint.name.view(),
              "' is not a finite number"});
    }
    if (position[j] < joint.limits.lower || position[j] > joint.limits.upper) {
      refuse({who, ": position ", position[j], " of joint '", joint.name.view(),
              "' is outside its limits ", joint.limits.lower, " .. ", joint.limits.upper});
    }
  }
}

}  // namespace articula::detail
