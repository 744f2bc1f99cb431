// SPDX-License-Identifier: Apache-2.0
/// @file Keeps one joint within its limits of position, velocity, acceleration and jerk.
#pragma once

#include "articula/control/limits/command_limits.hpp"
#include "articula/control/limits/command_slack.hpp"
#include "articula/control/limits/limit_report.hpp"
#include "articula/motion/stopping_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// Keeps one joint within its limits, cycle by cycle. It always has a stop in hand: a way to rest
/// that keeps all limits (StoppingMotion). A wish is granted if the joint, having followed it for
/// one cycle, still has such a stop, which is then the one in hand. Otherwise the joint follows the
/// stop in hand for one cycle, or goes as far towards the wish as a stop remains (by bisection).
///
/// The stop keeps the soft limits of position, too; they differ in that the reserve is not used for
/// them, and that the way towards them is slow where `soft_rate` is given.
///
/// So limits hold for ever, however wild the wishes, and the way back is always open: at a limit
/// the wish to leave it has a stop. A joint that is beyond a limit, because it was when control
/// began or was pushed there, may not go further and may come back: what the stop in hand cannot
/// avoid is allowed, and nothing beyond.
class JointLimiter {
 public:
  /// No limits.
  JointLimiter() = default;

  /// @param limits  that validate() accepts
  /// @param joint   whose they are
  template <int N>
  JointLimiter(const CommandLimits<N>& limits, int joint) noexcept
      : lower_(limits.lower[joint]),
        upper_(limits.upper[joint]),
        soft_lower_(limits.soft_lower[joint]),
        soft_upper_(limits.soft_upper[joint]),
        soft_rate_(limits.soft_rate[joint]),
        velocity_(limits.velocity[joint]),
        // What is unlimited is so large that it never limits and its powers do not overflow.
        acceleration_(std::min(limits.acceleration[joint], 1e15)),
        deceleration_(std::min(limits.deceleration[joint], acceleration_)),
        jerk_(std::min(limits.jerk[joint], 1e30)) {}

  /// Begins anew from a motion, for cycles of `period`. Real-time: yes.
  void start(const CommandMotion& motion, double period) noexcept {
    period_ = period;
    stop_ = stop_from(motion);
  }

  /// Goes on with cycles of another length [s]. The velocity stays, and the acceleration is cut to
  /// what can fade, in steps of the new length, before the velocity limit. So the motion keeps limits
  /// of position and velocity for any sequence of periods. Its acceleration and jerk may pass theirs
  /// for some cycles at the change.
  /// Real-time: yes. At most 21 stops are computed.
  void set_period(double period) noexcept {
    CommandMotion now = motion();
    start(now, period);
    const double most = std::max(velocity_, std::abs(now.velocity)) * (1 + 1e-12);  // rounding
    const ValueRange speeds{-most, most};
    if (within(stop_.velocities(), speeds)) return;
    double safe = 0, unsafe = now.acceleration;
    for (int k = 0; k < 20; ++k) {
      now.acceleration = safe + (unsafe - safe) / 2;
      (within(stop_from(now).velocities(), speeds) ? safe : unsafe) = now.acceleration;
    }
    now.acceleration = safe;
    stop_ = stop_from(now);
  }

  /// Where the joint is now. Real-time: yes.
  [[nodiscard]] const CommandMotion& motion() const noexcept { return stop_.motion(); }

  /// Puts the joint to where it was measured, without another change. Real-time: yes.
  void measured(double position) noexcept {
    stop_.move_to(position);
    if (beyond_limits(stop_) > 0) better_stop(motion());
  }

  /// Puts the joint into the motion that was measured. Real-time: yes.
  void measured(const CommandMotion& motion) noexcept {
    stop_ = StoppingMotion(motion, deceleration_, jerk_, period_);
    if (beyond_limits(stop_) > 0) better_stop(motion);
  }

  /// The next cycle's motion, as close to the wish as the limits allow.
  /// @param velocity  the wish, v_(k+1) [rad/s or m/s]; if not finite, the joint brakes
  /// @param report    what changed it is added here
  /// @param slack     what is not taken for beyond a limit
  /// @return          true if the wish was granted as it is; motion() is what is given
  /// Real-time: yes. At most 40 stops are computed.
  [[nodiscard]] bool move(double velocity, JointLimitReport& report,
                          const CommandSlack& slack = {}) noexcept {
    StoppingMotion braking = stop_;
    braking.advance();
    if (!is_finite(velocity)) {
      report.non_finite = true;
      stop_ = braking;
      return false;
    }
    const CommandMotion now = motion();
    double wish = velocity;
    const auto clamp = [](double& value, double low, double high, double beyond, bool& clamped) {
      const double within = CommandSlack::clamp(value, low, high, beyond);
      clamped = clamped || within != value;
      value = within;
    };
    const double k = std::min(soft_rate_, 1 / period_);  // faster would be beyond it in a cycle
    clamp(wish, std::min(0.0, -k * (now.position - soft_lower_)),
          std::max(0.0, k * (soft_upper_ - now.position)), 0, report.soft_position);
    clamp(wish, -velocity_, velocity_, slack.velocity, report.velocity);
    double acceleration = (wish - now.velocity) / period_;
    clamp(acceleration, -acceleration_, acceleration_, slack.acceleration, report.acceleration);
    clamp(acceleration, now.acceleration - jerk_ * period_, now.acceleration + jerk_ * period_,
          slack.step, report.jerk);
    const bool unchanged = wish == velocity && acceleration == (wish - now.velocity) / period_;
    if (!unchanged) wish = now.velocity + acceleration * period_;

    const ValueRange hard = hull(stop_.positions(), lower_, upper_);
    const ValueRange places =
        hull(stop_.positions(), std::max(lower_, soft_lower_), std::min(upper_, soft_upper_));
    const double top_speed = velocity_ + slack.velocity;
    const ValueRange speeds = hull(stop_.velocities(), -top_speed, top_speed);
    const auto has_stop = [&](const StoppingMotion& stop) {
      return within(stop.positions(), places) && within(stop.velocities(), speeds);
    };
    const auto going = [&](double v, double a) {
      return stop_from({now.position + v * period_, v, a});
    };
    const StoppingMotion granted = going(wish, acceleration);
    if (has_stop(granted)) {
      stop_ = granted;
      return unchanged;
    }
    const bool in_hard = within(granted.positions(), hard);
    const bool is_soft = in_hard && !within(granted.positions(), places);
    (!within(granted.velocities(), speeds) ? report.velocity
     : is_soft                             ? report.soft_position
                                           : report.position) = true;
    double safe = braking.motion().acceleration, unsafe = acceleration;
    for (int k_half = 0; k_half < 20; ++k_half) {
      const double middle = safe + (unsafe - safe) / 2;
      const StoppingMotion stop = going(now.velocity + middle * period_, middle);
      if (has_stop(stop)) {
        safe = middle;
        braking = stop;
      } else {
        unsafe = middle;
      }
    }
    stop_ = braking;
    return false;
  }

 private:
  [[nodiscard]] StoppingMotion stop_from(const CommandMotion& motion) const noexcept {
    return {motion, deceleration_, jerk_, period_};
  }

  [[nodiscard]] static ValueRange hull(const ValueRange& range, double low, double high) noexcept {
    return {std::min(range.lowest, low), std::max(range.highest, high)};
  }
  [[nodiscard]] static bool within(const ValueRange& range, const ValueRange& limits) noexcept {
    return range.lowest >= limits.lowest && range.highest <= limits.highest;
  }

  /// How far a stop leads beyond the position limits [rad or m].
  [[nodiscard]] double beyond_limits(const StoppingMotion& stop) const noexcept {
    const ValueRange places = stop.positions();
    return std::max({0.0, lower_ - places.lowest, places.highest - upper_});
  }

  /// Brakes harder than planned, with as much of the reserve as it takes: v^2/(2 x) for what is
  /// left of the way.
  void better_stop(const CommandMotion& motion) noexcept {
    if (!(deceleration_ < acceleration_)) return;
    const double v = motion.velocity;
    const double way = v > 0 ? upper_ - motion.position : motion.position - lower_;
    const double needed = way > 0 ? v * v / (2 * way) : acceleration_;
    const StoppingMotion harder(motion, std::clamp(needed, deceleration_, acceleration_), jerk_,
                                period_);
    if (beyond_limits(harder) < beyond_limits(stop_)) stop_ = harder;
  }

  double lower_ = -CommandLimits<1>::infinity;
  double upper_ = CommandLimits<1>::infinity;
  double soft_lower_ = -CommandLimits<1>::infinity;
  double soft_upper_ = CommandLimits<1>::infinity;
  double soft_rate_ = CommandLimits<1>::infinity;
  double velocity_ = CommandLimits<1>::infinity;
  double acceleration_ = 1e15;
  double deceleration_ = 1e15;
  double jerk_ = 1e30;
  double period_ = 1e-3;
  StoppingMotion stop_{};
};

}  // namespace articula
