// SPDX-License-Identifier: Apache-2.0
/// @file How one joint gets to the position that is asked for.
#pragma once

#include "articula/control/limits/command_limits.hpp"
#include "articula/control/limits/command_slack.hpp"
#include "articula/control/limits/limit_report.hpp"
#include "articula/motion/stopping_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// How one joint gets to the position that is asked for, without crossing it: it goes there as fast
/// as its limits allow, as long as it can still come to rest there (StoppingMotion). Its limits of
/// position are not looked at here; what comes of this is a wish for a JointLimiter.
///
/// A position that moves within the limits of velocity and acceleration is met in its own motion:
/// what must come to rest is the difference, as if the position asked for went on with the velocity
/// and acceleration of its last three values. (Jerks are not asked about: of rounded numbers they
/// are huge.) Where the joint is on it already it follows, whatever comes next. (A step of less
/// than some 2 J dt^3 cannot be told from that, and is crossed by as much at most.) One that jumps
/// is taken for one that rests, and so is one that changes every other cycle only, which the joint
/// therefore follows late by its way to brake. A crossing that the limits enforce, since what is
/// asked for comes towards the joint or turns round, is kept small.
class PositionApproach {
 public:
  /// No limits.
  PositionApproach() = default;

  /// @param limits  that validate() accepts
  /// @param joint   whose they are
  template <int N>
  PositionApproach(const CommandLimits<N>& limits, int joint) noexcept
      : velocity_(limits.velocity[joint]),
        acceleration_(std::min(limits.acceleration[joint], 1e15)),  // see JointLimiter
        deceleration_(std::min(limits.deceleration[joint], acceleration_)),
        jerk_(std::min(limits.jerk[joint], 1e30)) {}

  /// Forgets what was asked for. Real-time: yes.
  void start() noexcept { asked_before_ = 0; }

  /// The velocity v_(k+1) to wish for.
  /// @param now     the joint's motion in the last cycle
  /// @param asked   the position that is asked for in this one, finite [rad or m]
  /// @param period  dt > 0 [s]
  /// @param slack   what is not taken for beyond a limit
  /// @param report  what changed it is added here
  /// @return        (asked - q_k)/dt exactly if that can be wished for [rad/s or m/s]
  /// Real-time: yes. At most 34 stops are computed.
  [[nodiscard]] double wish(const CommandMotion& now, double asked, double period,
                            const CommandSlack& slack, JointLimitReport& report) noexcept {
    const bool on_it = asked_before_ == 0 || now.position == asked_.position;
    const bool moves = asked != (asked_before_ == 0 ? now.position : asked_.position);
    const CommandMotion goal = follow(asked, period);
    const double direct = (asked - now.position) / period;
    const double exact = (direct - now.velocity) / period;
    const double wished = reachable(now, exact, period, slack);
    if (on_it && moves && wished == exact) return direct;

    StoppingMotion landing = difference(now, before(goal, period), period);
    landing.advance();
    double safe = reachable(now, landing.motion().acceleration + goal.acceleration, period, slack);
    double unsafe = wished;
    const bool upwards = safe < wished;
    const auto crossing = [&](const StoppingMotion& stop) {
      const ValueRange way = stop.positions();
      return std::max(0.0, upwards ? way.highest : -way.lowest);
    };
    const auto going = [&](double acceleration) {
      const double v = now.velocity + acceleration * period;
      return difference({now.position + v * period, v, acceleration}, goal, period);
    };
    const double rounding = 1e-13 * (1 + std::abs(asked));
    const auto lands = [&](const StoppingMotion& stop) { return crossing(stop) <= rounding; };
    if (lands(going(wished))) return direct;
    for (int k = 0; k < 30; ++k) {
      const double middle = safe + (unsafe - safe) / 2;
      (lands(going(middle)) ? safe : unsafe) = middle;
    }
    (deceleration_ < 1e15 ? report.acceleration : report.jerk) = true;
    return now.velocity + safe * period;
  }

 private:
  /// Notes what is asked for.
  /// @return  its motion, as far as it can be followed
  [[nodiscard]] CommandMotion follow(double asked, double period) noexcept {
    const CommandMotion last = asked_;
    asked_.position = asked;
    asked_.velocity = asked_before_ > 0 ? (asked - last.position) / period : 0;
    asked_.acceleration = asked_before_ > 1 ? (asked_.velocity - last.velocity) / period : 0;
    asked_before_ = std::min(asked_before_ + 1, 2);
    const bool within = std::abs(asked_.velocity) <= velocity_ * (1 + 1e-6) &&
                        std::abs(asked_.acceleration) <= acceleration_ * (1 + 1e-6);
    return within ? asked_ : CommandMotion{asked, 0, 0};
  }

  /// Where a motion was a cycle before, at the same acceleration.
  [[nodiscard]] static CommandMotion before(const CommandMotion& m, double period) noexcept {
    return {m.position - m.velocity * period, m.velocity - m.acceleration * period, m.acceleration};
  }

  /// The acceleration within the limits that is closest to a wish.
  [[nodiscard]] double reachable(const CommandMotion& now, double acceleration, double period,
                                 const CommandSlack& slack) const noexcept {
    const auto clamp = [&](double low, double high, double beyond) {
      acceleration = CommandSlack::clamp(acceleration, low, high, beyond);
    };
    clamp(std::min(0.0, (-velocity_ - now.velocity) / period),
          std::max(0.0, (velocity_ - now.velocity) / period), slack.velocity / period);
    clamp(-acceleration_, acceleration_, slack.acceleration);
    clamp(now.acceleration - jerk_ * period, now.acceleration + jerk_ * period, slack.step);
    return acceleration;
  }

  /// How a joint comes to rest beside what moves itself.
  [[nodiscard]] StoppingMotion difference(const CommandMotion& joint, const CommandMotion& goal,
                                          double period) const noexcept {
    return {{joint.position - goal.position, joint.velocity - goal.velocity,
             joint.acceleration - goal.acceleration},
            deceleration_,
            jerk_,
            period};
  }

  double velocity_ = CommandLimits<1>::infinity;
  double acceleration_ = 1e15;
  double deceleration_ = 1e15;
  double jerk_ = 1e30;
  CommandMotion asked_{};  ///< its last value, and differences
  int asked_before_ = 0;   ///< how many values are known, at most 2
};

}  // namespace articula
