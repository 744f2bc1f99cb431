// SPDX-License-Identifier: Apache-2.0
/// @file Which joints are beyond their limits, in words.
#pragma once

#include "articula/core/joint_state.hpp"
#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <cmath>
#include <string>

namespace articula::remote {

/// "joint 'elbow': position 1.6 is not within -1.5 .. 1.5", for each position and velocity beyond
/// the limits of a robot's description. Empty if there is none. Real-time: no (allocates).
template <Robot R>
[[nodiscard]] std::string limit_excess(const R& robot, const JointState<joint_count<R>>& state) {
  std::string text;
  const auto add = [&](articula::detail::MessageParts parts) {
    text += (text.empty() ? "" : ", ") + articula::detail::message_of(parts);
  };
  for (int j = 0; j < joint_count<R>; ++j) {
    const JointProperties& joint = model_of(robot).joints[j];
    const double q = state.position[j], v = state.velocity[j];
    if (q < joint.limits.lower || q > joint.limits.upper) {
      add({"joint '", joint.name.view(), "': position ", q, " is not within ", joint.limits.lower,
           " .. ", joint.limits.upper});
    }
    if (std::abs(v) > joint.limits.velocity) {
      add({"joint '", joint.name.view(), "': velocity ", v, " is above the limit ",
           joint.limits.velocity});
    }
  }
  return text;
}

}  // namespace articula::remote
