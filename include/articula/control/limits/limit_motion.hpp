// SPDX-License-Identifier: Apache-2.0
/// @file The limits of one joint's motion, as a step from cycle to cycle.
#pragma once

#include "articula/control/limits/command_limits.hpp"
#include "articula/control/limits/limit_report.hpp"
#include "articula/motion/stopping_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The amounts by which differences of positions may exceed limits of velocity, acceleration and
/// jerk. Positions are rounded by up to 1.1e-16 of their size, and divided by the period once,
/// twice and three times. The amounts are twice that, for callers that apply the same limits
/// themselves.
struct CommandSlack {
  double velocity = 0;      ///< [rad/s or m/s]
  double acceleration = 0;  ///< [rad/s^2 or m/s^2]
  double step = 0;          ///< of the acceleration from cycle to cycle [rad/s^2 or m/s^2]

  /// No tolerance.
  CommandSlack() = default;

  /// @param position  [rad or m]
  /// @param period    dt > 0 [s]
  /// Real-time: yes.
  CommandSlack(double position, double period) noexcept
      : velocity(2e-15 * (1 + std::abs(position)) / period),
        acceleration(2 * velocity / period),
        step(2 * acceleration) {}

  /// A value, or the nearest end of a range if the value exceeds the range by more than the slack.
  /// Real-time: yes.
  [[nodiscard]] static double clamp(double value, double low, double high, double slack) noexcept {
    return value < low - slack ? low : value > high + slack ? high : value;
  }
};

/// The result of a step within limits.
struct MotionStep {
  StoppingMotion next{};      ///< the motion in the coming cycle, with the stop that follows it
  JointLimitReport report{};  ///< the limits that changed the request
  bool granted = false;       ///< the request passed unchanged
};

namespace detail {

[[nodiscard]] inline StoppingMotion stop_from(const JointMotion& motion,
                                              const JointCommandLimits& limits,
                                              double period) noexcept {
  return {motion, limits.deceleration, limits.jerk, period};
}

/// The distance by which a stop exceeds the position limits [rad or m].
[[nodiscard]] inline double distance_beyond(const StoppingMotion& stop,
                                            const JointCommandLimits& limits) noexcept {
  const ValueRange positions = stop.positions();
  return std::max({0.0, limits.lower - positions.lowest, positions.highest - limits.upper});
}

/// Replaces a stop that exceeds the position limits by a harder one. That uses as much of the
/// reserve between B and A as necessary: v^2/(2 x) for the remaining distance x.
inline void use_reserve(StoppingMotion& stop, const JointCommandLimits& limits) noexcept {
  const double beyond = distance_beyond(stop, limits);
  if (!(beyond > 0) || !(limits.deceleration < limits.acceleration)) return;
  const double v = stop.motion().velocity, q = stop.motion().position;
  const double distance = v > 0 ? limits.upper - q : q - limits.lower;
  const double needed = distance > 0 ? v * v / (2 * distance) : limits.acceleration;
  const StoppingMotion harder(stop.motion(),
                              std::clamp(needed, limits.deceleration, limits.acceleration),
                              limits.jerk, stop.period());
  if (distance_beyond(harder, limits) < beyond) stop = harder;
}

/// Changes the length of the cycles. The velocity stays. The acceleration is reduced until it can
/// fade, in steps of the new length, before the velocity limit. So velocities keep their limits for
/// any sequence of periods. Acceleration and jerk may exceed theirs for some cycles after the
/// change. Positions may, too, by as much as the stop is longer in cycles of the new length.
/// limit_position() keeps those. At most 21 stops are computed.
inline void set_period(StoppingMotion& stop, const JointCommandLimits& limits,
                       double period) noexcept {
  if (stop.period() == period) return;
  JointMotion motion = stop.motion();
  const double most =
      std::max(limits.velocity, std::abs(motion.velocity)) * (1 + 1e-12);  // rounding
  const auto keeps_velocity = [&] {
    stop = stop_from(motion, limits, period);
    return stop.velocities().is_within({-most, most});
  };
  if (keeps_velocity()) return;
  double safe = 0, unsafe = motion.acceleration;
  for (int k = 0; k < 20; ++k) {
    motion.acceleration = safe + (unsafe - safe) / 2;
    (keeps_velocity() ? safe : unsafe) = motion.acceleration;
  }
  motion.acceleration = safe;
  stop = stop_from(motion, limits, period);
}

}  // namespace detail

/// Limits the motion of one joint in the coming cycle.
///
/// The state between cycles is a StoppingMotion: the present motion with a stop that keeps all
/// limits. The caller holds it and passes it on:
///
///     const JointCommandLimits limits = command_limits(robot).of_joint(j);
///     StoppingMotion state({.position = q}, limits.deceleration, limits.jerk, dt);
///     const MotionStep step = limit_motion(state, request, limits, dt);
///     send(step.next.motion().velocity);
///     state = step.next;
///
/// - The step grants a request if, after one cycle with it, the joint still has a stop within the
///   limits. Otherwise the joint follows the present stop for one cycle, or goes as far towards the
///   request as a stop remains (by bisection).
/// - So limits hold for any sequence of requests, and a joint at a limit can always move back.
/// - A joint outside its limits may come back and moves no further out than its stop must.
/// - Soft limits of position hold likewise, without the reserve between B and A. `soft_rate` bounds
///   the velocity towards them.
///
/// @param now       the motion in the last cycle
/// @param velocity  the request, v_(k+1) [rad/s or m/s]; if it is not finite, the joint brakes
/// @param joint_limits  of the joint
/// @param period    dt > 0 of the coming cycle [s]
/// @param slack     rounding that does not count as beyond a limit
/// @param report    limits that changed the request before; this step adds its own
/// Real-time: yes. At most 61 stops are computed.
[[nodiscard]] inline MotionStep limit_motion(StoppingMotion now, double velocity,
                                             const JointCommandLimits& joint_limits, double period,
                                             const CommandSlack& slack = {},
                                             JointLimitReport report = {}) noexcept {
  const JointCommandLimits limits = joint_limits.bounded();
  detail::set_period(now, limits, period);
  StoppingMotion braking = now;
  braking.advance();
  if (!is_finite(velocity)) {
    report.non_finite = true;
    return {braking, report, false};
  }
  const auto [q, v, a] = now.motion();
  const auto clamp = [](double value, double low, double high, double tolerance, bool& clamped) {
    const double within = CommandSlack::clamp(value, low, high, tolerance);
    clamped = clamped || within != value;
    return within;
  };
  const double rate = std::min(limits.soft_rate, 1 / period);  // one cycle suffices at 1/dt
  double wish = clamp(velocity, std::min(0.0, -rate * (q - limits.soft_lower)),
                      std::max(0.0, rate * (limits.soft_upper - q)), 0, report.soft_position);
  wish = clamp(wish, -limits.velocity, limits.velocity, slack.velocity, report.velocity);
  const double direct = (wish - v) / period;
  double acceleration = clamp(direct, -limits.acceleration, limits.acceleration, slack.acceleration,
                              report.acceleration);
  acceleration = clamp(acceleration, a - limits.jerk * period, a + limits.jerk * period, slack.step,
                       report.jerk);
  const bool unchanged = wish == velocity && acceleration == direct;
  if (!unchanged) wish = v + acceleration * period;

  // What the present stop cannot avoid is allowed, and nothing beyond.
  const ValueRange present = now.positions();
  const ValueRange hard = present.extended_to(limits.lower).extended_to(limits.upper);
  const ValueRange positions = present.extended_to(std::max(limits.lower, limits.soft_lower))
                                   .extended_to(std::min(limits.upper, limits.soft_upper));
  const double top_speed = limits.velocity + slack.velocity;
  const ValueRange velocities = now.velocities().extended_to(-top_speed).extended_to(top_speed);
  const auto is_safe = [&](const StoppingMotion& stop) {
    return stop.positions().is_within(positions) && stop.velocities().is_within(velocities);
  };
  const auto going = [&](double v_next, double a_next) {
    return detail::stop_from({q + v_next * period, v_next, a_next}, limits, period);
  };
  const StoppingMotion granted = going(wish, acceleration);
  if (is_safe(granted)) return {granted, report, unchanged};
  (!granted.velocities().is_within(velocities) ? report.velocity
   : granted.positions().is_within(hard)       ? report.soft_position
                                               : report.position) = true;
  double safe = braking.motion().acceleration, unsafe = acceleration;
  for (int k = 0; k < 20; ++k) {
    const double middle = safe + (unsafe - safe) / 2;
    const StoppingMotion stop = going(v + middle * period, middle);
    if (is_safe(stop)) {
      safe = middle;
      braking = stop;
    } else {
      unsafe = middle;
    }
  }
  return {braking, report, false};
}

/// Limits the velocity command of one joint in the coming cycle: limit_motion() from the measured
/// position. `next.motion().velocity` is the command.
/// @param now       the motion in the last cycle
/// @param position  measured [rad or m]; ignored if not finite
/// @param velocity  the request [rad/s or m/s]; if it is not finite, the joint brakes
/// @param joint_limits  of the joint
/// @param period    dt > 0 of the coming cycle [s]
/// Real-time: yes. At most 61 stops are computed.
[[nodiscard]] inline MotionStep limit_velocity(StoppingMotion now, double position, double velocity,
                                               const JointCommandLimits& joint_limits,
                                               double period) noexcept {
  const JointCommandLimits limits = joint_limits.bounded();
  detail::set_period(now, limits, period);
  if (is_finite(position)) {
    now.move_to(position);
    detail::use_reserve(now, limits);
  }
  return limit_motion(now, velocity, limits, period);
}

}  // namespace articula
