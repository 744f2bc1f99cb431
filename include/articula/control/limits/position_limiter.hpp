// SPDX-License-Identifier: Apache-2.0
/// @file Position commands of one joint within its limits.
#pragma once

#include "articula/control/limits/joint_limiter.hpp"
#include "articula/control/limits/position_approach.hpp"

#include <algorithm>
#include <limits>

namespace articula {

/// Position commands of one joint within its limits: a JointLimiter, whose wishes are those of a
/// PositionApproach.
class PositionLimiter {
 public:
  /// No limits.
  PositionLimiter() = default;

  /// @param limits  that validate() accepts
  /// @param joint   whose they are
  template <int N>
  PositionLimiter(const CommandLimits<N>& limits, int joint) noexcept
      : limiter_(limits, joint),
        approach_(limits, joint),
        lower_(limits.lower[joint]),
        upper_(limits.upper[joint]) {}

  /// Begins anew from a motion, for cycles of `period`. Real-time: yes.
  void start(const CommandMotion& motion, double period) noexcept {
    approach_.start();
    limiter_.start(motion, period);
    period_ = period;
  }

  /// Goes on with cycles of another length [s]. Real-time: yes.
  void set_period(double period) noexcept {
    limiter_.set_period(period);
    period_ = period;
  }

  /// The next cycle's command.
  /// @param asked   the position that is asked for, finite [rad or m]
  /// @param report  what changed it is added here
  /// @return        the position that is given [rad or m]
  /// Real-time: yes. At most 74 stops are computed.
  [[nodiscard]] double limit(double asked, JointLimitReport& report) noexcept {
    const CommandMotion now = limiter_.motion();
    // What lies far out would leave no digits for the way to the limit.
    const double lowest = std::min(lower_, now.position);
    const double highest = std::max(upper_, now.position);
    const double wanted = std::clamp(asked, lowest, highest);
    if (asked < lowest || asked > highest) report.position = true;
    const double direct = (wanted - now.position) / period_;
    const CommandSlack slack(now.position, period_);
    const double wish = approach_.wish(now, wanted, period_, slack, report);
    const bool granted = limiter_.move(wish, report, slack) && wish == direct;
    // Rounding must not lead beyond a limit, nor away from what was granted.
    return give(granted ? wanted : limiter_.motion().position, lowest, highest);
  }

  /// Brakes for a cycle. What is asked for next is approached as after a start.
  /// @return  the position that is given [rad or m]
  /// Real-time: yes.
  [[nodiscard]] double brake(JointLimitReport& report) noexcept {
    approach_.start();
    const double from = limiter_.motion().position;
    static_cast<void>(limiter_.move(std::numeric_limits<double>::quiet_NaN(), report));
    return give(limiter_.motion().position, std::min(lower_, from), std::max(upper_, from));
  }

 private:
  [[nodiscard]] double give(double position, double lowest, double highest) noexcept {
    const double given = std::clamp(position, lowest, highest);
    limiter_.measured(given);
    return given;
  }

  JointLimiter limiter_{};
  PositionApproach approach_{};
  double lower_ = -CommandLimits<1>::infinity;
  double upper_ = CommandLimits<1>::infinity;
  double period_ = 1e-3;
};

}  // namespace articula
