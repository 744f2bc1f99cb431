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
template <Robot R>
class ForwardPosition : public PositionController<R, PositionFeedforward<joint_count<R>>> {
 public:
  static constexpr std::string_view name = "forward_position";

  ForwardPosition()
    requires DescribedRobot<R>
      : ForwardPosition(R()) {}
  explicit ForwardPosition(const R& robot)
      : PositionController<R, PositionFeedforward<articula::joint_count<R>>>(robot, {}) {}
};

}  // namespace articula
