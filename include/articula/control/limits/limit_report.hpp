// SPDX-License-Identifier: Apache-2.0
/// @file What was held back from a joint.
#pragma once

#include "articula/core/joint_array.hpp"

namespace articula {

/// Which limits changed one joint's command in a cycle, and by how much. What was asked and given
/// is the position, the velocity or the effort, as the command is; of a MultiModeCommand the whole
/// effort that it makes at the measured state.
struct JointLimitReport {
  bool position = false;       ///< it would not have stopped before its position limit
  bool soft_position = false;  ///< it approached its soft limit too fast, or would have passed it
  bool velocity = false;
  bool acceleration = false;
  bool jerk = false;
  bool effort = false;
  bool effort_rate = false;
  bool stiffness = false;   ///< of a MultiModeCommand: it was negative
  bool damping = false;     ///< likewise
  bool non_finite = false;  ///< command, reference or state had a NaN or infinity: it was braked
  double asked = 0;         ///< [rad, m; rad/s, m/s; N m, N]; may be NaN or infinite
  double given = 0;         ///< likewise, finite

  /// Whether anything was changed. Real-time: yes.
  [[nodiscard]] constexpr bool any() const noexcept {
    return position || soft_position || velocity || acceleration || jerk || effort || effort_rate ||
           stiffness || damping || non_finite;
  }
};

/// The reports of N joints.
template <int N>
using LimitReport = JointArray<JointLimitReport, N>;

}  // namespace articula
