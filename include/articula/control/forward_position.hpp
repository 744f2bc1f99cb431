// SPDX-License-Identifier: Apache-2.0
/// @file Position commands equal to the reference.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <string_view>

namespace articula {

/// Position drives go where the reference says: position = clamp(q_ref), within the joints' limits.
/// Uses the reference's position alone.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class ForwardPosition : public SumController<R, PositionCommand<joint_count<R>, S>,
                                             PositionFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "forward_position";

  ForwardPosition()
    requires DescribedRobot<R>
      : ForwardPosition(R()) {}
  explicit ForwardPosition(const R& robot) : ForwardPosition::SumController(robot, {}) {}
};

}  // namespace articula
