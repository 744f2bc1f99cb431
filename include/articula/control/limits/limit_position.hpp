// SPDX-License-Identifier: Apache-2.0
/// @file The limits of one joint's position commands, as a step from cycle to cycle.
#pragma once

#include "articula/control/limits/limit_motion.hpp"

#include <algorithm>
#include <cmath>

namespace articula {

/// The state of a joint's position limits between two cycles.
struct PositionLimitState {
  StoppingMotion stop{};    ///< the last command, and the stop that follows it
  JointMotion requested{};  ///< the last requested position and its differences
  int requests = 0;         ///< number of known requested positions, at most 2
};

/// The result of a step within position limits.
struct PositionStep {
  PositionLimitState next{};  ///< `next.stop.motion().position` is the command
  JointLimitReport report{};  ///< the limits that changed the request
};

namespace detail {

/// The acceleration within the limits that is closest to a requested one.
[[nodiscard]] inline double reachable_acceleration(const StoppingMotion& now, double requested,
                                                   const JointCommandLimits& limits,
                                                   const CommandSlack& slack) noexcept {
  const double period = now.period(), v = now.motion().velocity, a = now.motion().acceleration;
  const double by_velocity =
      CommandSlack::clamp(requested, std::min(0.0, (-limits.velocity - v) / period),
                          std::max(0.0, (limits.velocity - v) / period), slack.velocity / period);
  const double by_acceleration = CommandSlack::clamp(by_velocity, -limits.acceleration,
                                                     limits.acceleration, slack.acceleration);
  return CommandSlack::clamp(by_acceleration, a - limits.jerk * period, a + limits.jerk * period,
                             slack.step);
}

/// The velocity of the coming cycle with which a joint approaches a position without crossing it.
/// The joint moves as fast as velocity, acceleration and jerk allow, as long as it can still stop
/// at the position (StoppingMotion). Position limits are those of limit_motion().
///
/// A requested position that moves within the limits of velocity and acceleration is approached in
/// its own motion. The request is assumed to continue with the velocity and acceleration of its
/// last three values. The difference must then come to rest. Jerk is not checked: differentiating
/// rounded positions three times amplifies rounding error.
///
/// - A joint that is already at the requested position follows it. A step below about 2 J dt^3
///   looks like the beginning of such a motion, and is crossed by that much at most.
/// - A request that jumps counts as one at rest. So does one that changes only every other cycle;
///   the joint follows it late by its braking distance.
/// - If the request turns round or approaches the joint, limits may enforce a small crossing.
///
/// @param state   its `requested` is the request of this cycle
/// @param last    the requested position in the last cycle [rad or m]
/// @param slowed  set if the joint must brake for the position
/// @return        (requested - q_k)/dt exactly if that is possible [rad/s or m/s]
[[nodiscard]] inline double approach_velocity(const PositionLimitState& state, double last,
                                              const JointCommandLimits& limits,
                                              const CommandSlack& slack, bool& slowed) noexcept {
  const JointMotion& now = state.stop.motion();
  const double period = state.stop.period(), request = state.requested.position;
  const double direct = (request - now.position) / period;
  const double exact = (direct - now.velocity) / period;
  double unsafe = reachable_acceleration(state.stop, exact, limits, slack);
  if (now.position == last && request != last && unsafe == exact) return direct;

  JointMotion goal = state.requested;
  if (!(std::abs(goal.velocity) <= limits.velocity * (1 + 1e-6) &&
        std::abs(goal.acceleration) <= limits.acceleration * (1 + 1e-6))) {
    goal = {request, 0, 0};
  }
  const auto stop_beside = [&](const JointMotion& joint, const JointMotion& other) {
    return stop_from({joint.position - other.position, joint.velocity - other.velocity,
                      joint.acceleration - other.acceleration},
                     limits, period);
  };
  StoppingMotion landing =
      stop_beside(now, {goal.position - goal.velocity * period,
                        goal.velocity - goal.acceleration * period, goal.acceleration});
  landing.advance();
  double safe = reachable_acceleration(
      state.stop, landing.motion().acceleration + goal.acceleration, limits, slack);
  const bool upwards = safe < unsafe;
  const double rounding = 1e-13 * (1 + std::abs(request));
  const auto lands = [&](double acceleration) {
    const double v = now.velocity + acceleration * period;
    const ValueRange positions =
        stop_beside({now.position + v * period, v, acceleration}, goal).positions();
    return (upwards ? positions.highest : -positions.lowest) <= rounding;
  };
  if (lands(unsafe)) return direct;
  for (int k = 0; k < 30; ++k) {
    const double middle = safe + (unsafe - safe) / 2;
    (lands(middle) ? safe : unsafe) = middle;
  }
  slowed = true;
  return now.velocity + safe * period;
}

}  // namespace detail

/// Limits the position command of one joint in the coming cycle. The joint approaches the requested
/// position without crossing it, and limit_motion() keeps its limits.
/// @param state     after the last cycle; at the start
///                  {.stop = {{.position = q}, limits.deceleration, limits.jerk, period}}
///                  with limits that are `bounded()`
/// @param position  the request [rad or m]; if it is not finite, the joint brakes, and approaches
///                  the next request as after a start
/// @param joint_limits  of the joint
/// @param period    dt > 0 of the coming cycle [s]
/// Real-time: yes. At most 95 stops are computed.
[[nodiscard]] inline PositionStep limit_position(PositionLimitState state, double position,
                                                 const JointCommandLimits& joint_limits,
                                                 double period) noexcept {
  const JointCommandLimits limits = joint_limits.bounded();
  detail::set_period(state.stop, limits, period);
  const double from = state.stop.motion().position;
  const double lowest = std::min(limits.lower, from), highest = std::max(limits.upper, from);
  MotionStep step;
  double command = 0;
  if (!is_finite(position)) {
    state.requests = 0;
    step = limit_motion(state.stop, position, limits, period);
    command = step.next.motion().position;
  } else {
    // The distance to a request far outside would leave no digits for the distance to the limit.
    const double request = std::clamp(position, lowest, highest);
    const JointMotion before = state.requests == 0 ? JointMotion{from, 0, 0} : state.requested;
    state.requested = {request, 0, 0};
    if (state.requests > 0) state.requested.velocity = (request - before.position) / period;
    if (state.requests > 1) {
      state.requested.acceleration = (state.requested.velocity - before.velocity) / period;
    }
    state.requests = std::min(state.requests + 1, 2);
    JointLimitReport report{.position = position != request};
    const CommandSlack slack(from, period);
    bool slowed = false;
    const double velocity =
        detail::approach_velocity(state, before.position, limits, slack, slowed);
    if (slowed) (limits.deceleration < 1e15 ? report.acceleration : report.jerk) = true;
    step = limit_motion(state.stop, velocity, limits, period, slack, report);
    const bool exact = step.granted && velocity == (request - from) / period;
    command = exact ? request : step.next.motion().position;
  }
  // Rounding must not exceed a limit, nor change a granted request.
  state.stop = step.next;
  state.stop.move_to(std::clamp(command, lowest, highest));
  detail::use_reserve(state.stop, limits);
  return {state, step.report};
}

}  // namespace articula
