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
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class ForwardVelocity : public SumController<R, VelocityCommand<joint_count<R>, S>,
                                             VelocityFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "forward_velocity";

  ForwardVelocity()
    requires DescribedRobot<R>
      : ForwardVelocity(R()) {}
  explicit ForwardVelocity(const R& robot) : ForwardVelocity::SumController(robot, {}) {}
};

}  // namespace articula
