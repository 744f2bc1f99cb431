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
template <Robot R>
class Bypass : public EffortController<R, EffortFeedforward<joint_count<R>>> {
 public:
  static constexpr std::string_view name = "bypass";

  Bypass()
    requires DescribedRobot<R>
      : Bypass(R()) {}
  explicit Bypass(const R& robot)
      : EffortController<R, EffortFeedforward<articula::joint_count<R>>>(robot, {}) {}
};

}  // namespace articula
