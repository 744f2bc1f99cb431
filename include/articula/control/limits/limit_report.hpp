// SPDX-License-Identifier: Apache-2.0
/// @file The report of limits that changed a command.
#pragma once

#include "articula/core/joint_array.hpp"

namespace articula {

/// The limits that changed one joint's command in a cycle, and its values before and after. The
/// values are positions, velocities or efforts, as the command is. For a MultiModeCommand they are
/// the total effort at the measured state.
struct JointLimitReport {
  bool position = false;       ///< the joint could not have stopped before its position limit
  bool soft_position = false;  ///< likewise of a soft limit, or it approached one too fast
  bool velocity = false;
  bool acceleration = false;
  bool jerk = false;
  bool effort = false;
  bool effort_rate = false;
  bool stiffness = false;   ///< that of a MultiModeCommand was negative
  bool damping = false;     ///< likewise
  bool non_finite = false;  ///< command, reference or state were not finite: the joint brakes
  double asked = 0;         ///< before limits [rad, m; rad/s, m/s; N m, N]; may be NaN or infinite
  double limited = 0;       ///< after limits, likewise; finite

  /// Whether a limit changed the command. Real-time: yes.
  [[nodiscard]] constexpr bool any() const noexcept {
    return position || soft_position || velocity || acceleration || jerk || effort || effort_rate ||
           stiffness || damping || non_finite;
  }
};

/// The reports of N joints.
template <int N>
using LimitReport = JointArray<JointLimitReport, N>;

}  // namespace articula
