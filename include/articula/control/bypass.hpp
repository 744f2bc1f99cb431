// SPDX-License-Identifier: Apache-2.0
/// @file Open-loop control: the effort is the reference's effort.
#pragma once

#include "articula/control/laws/feedforward.hpp"
#include "articula/control/laws/sum_controller.hpp"

#include <string_view>

namespace articula {

/// Open-loop control: effort = clamp(effort_ref).
/// Uses the reference's effort alone.
/// @tparam R  the robot
/// @tparam S  type of a number: double, or a pack with the numbers of several robots
template <Robot R, class S = double>
class Bypass : public SumController<R, EffortCommand<joint_count<R>, S>,
                                    EffortFeedforward<joint_count<R>, S>> {
 public:
  static constexpr std::string_view name = "bypass";

  Bypass()
    requires DescribedRobot<R>
      : Bypass(R()) {}
  explicit Bypass(const R& robot) : Bypass::SumController(robot, {}) {}
};

}  // namespace articula
