// SPDX-License-Identifier: Apache-2.0
/// @file Why a trajectory was refused in the loop, in figures.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/model/robot.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace articula {

/// Why a trajectory was refused: the figure at fault and the rule that it breaks. The texts are
/// literals, so that it can be made and handed on in the control loop.
struct TrajectoryRefusal {
  std::string_view what{};  ///< the figure, such as "path_position"; empty: nothing was refused
  double value = 0;         ///< its value, in SI units
  int joint = -1;           ///< index of the joint whose it is; -1: of none alone
  std::string_view rule{};  ///< what it breaks, such as "is not a number >= 0"
  std::optional<double> limit{};  ///< beyond which it is, where there is one
};

/// The refusal in one line: `path_position -1 of joint 'elbow' is not a number >= 0`. Empty if
/// nothing was refused.
/// Real-time: no (allocates).
template <Robot R>
[[nodiscard]] std::string to_string(const R& robot, const TrajectoryRefusal& refusal) {
  if (refusal.what.empty()) return {};
  std::string text = detail::message_of({refusal.what, " ", refusal.value});
  if (refusal.joint >= 0) {
    const JointProperties& joint = model_of(robot).joints[static_cast<std::size_t>(refusal.joint)];
    text += detail::message_of({" of joint '", joint.name.view(), "'"});
  }
  text += detail::message_of({" ", refusal.rule});
  if (refusal.limit) text += detail::message_of({" ", *refusal.limit});
  return text;
}

}  // namespace articula
