// SPDX-License-Identifier: Apache-2.0
/// @file The reference experiments: initial position, reference and duration.
#pragma once

#include "articula/robots/q2d.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace articula::examples {

/// A pair of numbers, shoulder and elbow.
using Q2dVector = JointVector<joint_count<Q2d>>;

/// From rest at `initial` the reference jumps, at time 0, to a constant position or effort.
struct Experiment {
  std::string name;  ///< names its files as well
  /// True: `target` is an effort [N m] and the position reference stays at `initial`. That is
  /// open-loop control for Bypass; to the others, which add it to their own effort, it is a
  /// disturbance to reject.
  /// False: `target` is a position [rad] and no effort is asked for.
  bool is_torque = false;
  Q2dVector initial = Q2dVector::Zero();  ///< position at time 0 [rad], 2 x 1
  Q2dVector target = Q2dVector::Zero();   ///< [N m] or [rad], 2 x 1
  double duration = 0;                    ///< [s]

  /// The reference from time 0 on.
  [[nodiscard]] JointReference<joint_count<Q2d>> reference() const {
    if (is_torque) return {.position = initial, .effort = target};
    return {.position = target};
  }
};

/// The course's experiments: a torque on both joints, a step meant to be small enough for the
/// drives, and one that is not.
[[nodiscard]] inline std::vector<Experiment> reference_experiments() {
  return {
      {.name = "open-loop-torque", .is_torque = true, .target = {1, 1}, .duration = 2},
      {.name = "small-step", .initial = {-0.01, -0.01}, .target = {0.01, 0.01}, .duration = 1},
      {.name = "large-step", .target = {-1, 1}, .duration = 2},
  };
}

/// A joint's name as far as people need it: "shoulder" of "shoulder_active_joint".
[[nodiscard]] constexpr std::string_view short_name(std::string_view joint) {
  return joint.substr(0, joint.find('_'));
}

}  // namespace articula::examples
