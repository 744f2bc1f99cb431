// SPDX-License-Identifier: Apache-2.0
/// @file Velocity commands equal to the reference.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <string_view>

namespace articula {

/// Velocity drives go as fast as the reference says: velocity = clamp(v_ref), within the joints'
/// limits. Uses the reference's velocity alone.
/// @tparam R  the robot
template <Robot R>
class ForwardVelocity : public VelocityController<R, VelocityFeedforward<joint_count<R>>> {
 public:
  static constexpr std::string_view name = "forward_velocity";

  ForwardVelocity()
    requires DescribedRobot<R>
      : ForwardVelocity(R()) {}
  explicit ForwardVelocity(const R& robot)
      : VelocityController<R, VelocityFeedforward<articula::joint_count<R>>>(robot, {}) {}
};

}  // namespace articula
