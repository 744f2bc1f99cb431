// SPDX-License-Identifier: Apache-2.0
/// @file Why a trajectory was refused in the loop, in figures.
#pragma once

#include "articula/model/robot.hpp"

#include <optional>
#include <sstream>
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

/// The refusal in one line: `path_position -1 of joint 'elbow' is not a number >= 0`. Empty if nothing
/// was refused.
/// Real-time: no (allocates).
template <Robot R>
[[nodiscard]] std::string to_string(const TrajectoryRefusal& refusal, const R& robot) {
  if (refusal.what.empty()) return {};
  std::ostringstream text;
  text << refusal.what << ' ' << refusal.value;
  if (refusal.joint >= 0) {
    text << " of joint '" << model_of(robot).joints[static_cast<std::size_t>(refusal.joint)].name
         << '\'';
  }
  text << ' ' << refusal.rule;
  if (refusal.limit) text << ' ' << *refusal.limit;
  return text.str();
}

}  // namespace articula
