// SPDX-License-Identifier: Apache-2.0
/// @file One joint's fastest motion from any state to any other.
#pragma once

#include "articula/reference/braking_motion.hpp"
#include "articula/reference/furthest_motion.hpp"
#include "articula/reference/motion_bounds.hpp"
#include "articula/reference/timed_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace articula {

/// Motions of one joint from a state (position, velocity, acceleration) to another one within
/// limits of velocity, acceleration and jerk: the fastest one, and one of each longer duration that
/// there is [Berscheid, Kröger 2021].
///
/// All motions of duration T between two velocities and accelerations form a convex set. So the
/// distances that they lead over form an interval, from D-(T) to D+(T), whose ends are those of two
/// known motions (FurthestMotion). A motion over the distance D takes T if D-(T) <= D <= D+(T). The
/// fastest one is at an end of such an interval of T, where D-(T) = D or D+(T) = D: it is the
/// shortest solution of these equations. A slower one is the mixture of the two motions that leads
/// over D, which keeps all limits because the set is convex.
///
/// A start outside the limits is led back inside first (braking_motion()).
class StateToStateMotion {
 public:
  StateToStateMotion() = default;

  /// @param start, target  the states; finite
  /// @param bounds         limits as validate() accepts them
  /// Real-time: yes.
  StateToStateMotion(const JointMotion& start, const JointMotion& target,
                     const MotionBounds& bounds) noexcept
      : target_(target), bounds_(bounds), brake_(braking_motion(start, bounds)) {
    // The end, backwards in time, must have a motion that leads to it.
    const double a = target.acceleration, J = bounds.jerk;
    const double bend = a / 2 / J * std::abs(a);
    const auto within = [](double low, double x, double high) {
      const double rounding = 1e-12 * (high - low);
      return x >= low - rounding && x <= high + rounding;
    };
    const double low = bounds.lowest_velocity, high = bounds.highest_velocity;
    if (!within(bounds.lowest_acceleration, a, bounds.highest_acceleration) ||
        !within(low, target.velocity, high) || !within(low, target.velocity - bend, high)) {
      return;
    }
    for (const double side : {1.0, -1.0}) {
      furthest(side).for_each_solution([&](const detail::FurthestMotion& motion) {
        const double duration = brake_.duration() + motion.duration() / J;
        solutions_.add(duration);
        if (!(duration < least_duration_)) return;
        least_duration_ = duration;
        fastest_ = motion;
        fastest_side_ = side;
      });
    }
  }

  /// Whether there is a motion: the target must be within the limits, and it must be possible to
  /// have arrived there within them. Real-time: yes.
  [[nodiscard]] bool exists() const noexcept { return solutions_.size > 0; }

  /// The duration of the fastest motion [s]; infinity if there is none. Real-time: yes.
  [[nodiscard]] double least_duration() const noexcept { return least_duration_; }

  /// Whether there is a motion of a duration [s]. From some velocities and accelerations to others
  /// there are gaps: a joint that can arrive in time may have to turn around to arrive later.
  /// Real-time: yes.
  [[nodiscard]] bool can_take(double duration) const noexcept {
    if (is_solution(duration)) return true;
    detail::FurthestMotion up, down;
    double share = 0;
    return duration > least_duration_ && mixture(duration, up, down, share);
  }

  /// The end of the gap in which a duration lies [s]; infinity if there is none. Real-time: yes.
  [[nodiscard]] double next_duration(double duration) const noexcept {
    double next = std::numeric_limits<double>::infinity();
    for (const double solution : solutions_) {
      if (solution > duration && !(solution >= next)) next = solution;
    }
    return next;
  }

  /// The motion of a duration for which can_take() is true, or of the least one.
  /// Real-time: yes.
  [[nodiscard]] TimedMotion motion(double duration) const noexcept {
    TimedMotion result = brake_;
    detail::FurthestMotion up, down;
    double share = 0;
    if (duration > least_duration_ && mixture(duration, up, down, share)) {
      append_mixture(result, up, down, share);
    } else {
      append_mixture(result, fastest_, fastest_, fastest_side_ > 0 ? 1 : 0);
    }
    result.end_at(target_, std::max(duration, least_duration_));
    return result;
  }

 private:
  [[nodiscard]] bool is_solution(double duration) const noexcept {
    return std::find(solutions_.begin(), solutions_.end(), duration) != solutions_.end();
  }

  /// The problem in the unit of time in which the jerk is 1, seen in one direction.
  [[nodiscard]] detail::FurthestMotions furthest(double side) const noexcept {
    const JointMotion& from = brake_.end();
    const double J = bounds_.jerk, v0 = side * J * from.velocity, v1 = side * J * target_.velocity;
    const double a0 = side * from.acceleration, a1 = side * target_.acceleration;
    const double distance = side * J * J * (target_.position - from.position);
    const bool up = side > 0;
    const double lowest = up ? bounds_.lowest_acceleration : -bounds_.highest_acceleration;
    const double highest = up ? bounds_.highest_acceleration : -bounds_.lowest_acceleration;
    const double velocity = J * (up ? bounds_.highest_velocity : -bounds_.lowest_velocity);
    const double positions = J * J * (std::abs(target_.position) + std::abs(from.position));
    // States at a limit may be beyond it by rounding, which widens the limit.
    return detail::FurthestMotions(
        {.v0 = v0,
         .a0 = a0,
         .v1 = v1,
         .a1 = a1,
         .lowest_acceleration = std::min({lowest, a0, a1}),
         .highest_acceleration = std::max({highest, a0, a1}),
         .highest_velocity =
             std::max({velocity, v0 + std::max(0.0, a0) * a0 / 2, v1 + std::min(0.0, a1) * a1 / 2}),
         .distance = distance,
         .distance_rounding = 1e-14 * positions});
  }

  /// The two furthest motions of a duration, and how much of the upper one leads to the target.
  /// @return whether there are such
  [[nodiscard]] bool mixture(double duration, detail::FurthestMotion& up,
                             detail::FurthestMotion& down, double& share) const noexcept {
    const double J = bounds_.jerk, scaled = J * (duration - brake_.duration());
    if (!furthest(1).of_duration(scaled, up) || !furthest(-1).of_duration(scaled, down)) {
      return false;
    }
    const double distance = J * J * (target_.position - brake_.end().position);
    const double most = up.distance(), least = -down.distance();
    const double rounding = 1e-11 * (up.length + down.length);
    if (distance > most + rounding || distance < least - rounding) return false;
    share = most > least ? std::clamp((distance - least) / (most - least), 0.0, 1.0) : 0.5;
    return true;
  }

  /// Appends share * up + (1 - share) * down.
  void append_mixture(TimedMotion& motion, const detail::FurthestMotion& up,
                      const detail::FurthestMotion& down, double share) const noexcept {
    const double J = bounds_.jerk, left = 1 - share, start = brake_.end().position;
    const double duration = share > 0 ? up.duration() : down.duration();
    const double a0 = brake_.end().acceleration;  // beyond a limit by rounding at most
    const double lowest = std::min(bounds_.lowest_acceleration, a0);
    const double highest = std::max(bounds_.highest_acceleration, a0);
    const auto state = [&](std::size_t i, std::size_t k, double time) -> JointMotion {
      const auto u = up.at(i, time), d = down.at(k, time);
      return {start + (share * u.position - left * d.position) / J / J,
              (share * u.velocity - left * d.velocity) / J,
              std::clamp(share * u.acceleration - left * d.acceleration, lowest, highest)};
    };
    std::size_t i = 0, k = 0;
    for (double time = 0; time < duration;) {
      while (i < 6 && up.moments[i + 1].time <= time) ++i;
      while (k < 6 && down.moments[k + 1].time <= time) ++k;
      double next = duration;
      for (const double end : {up.moments[i + 1].time, down.moments[k + 1].time}) {
        if (end > time) next = std::min(next, end);
      }
      motion.append(J * (share * detail::furthest_jerks[i] - left * detail::furthest_jerks[k]),
                    (next - time) / J);
      motion.end_at(state(i, k, next));
      time = next;
    }
  }

  JointMotion target_{};
  MotionBounds bounds_{};
  TimedMotion brake_{};
  RootList<96> solutions_{};
  double least_duration_ = std::numeric_limits<double>::infinity();
  detail::FurthestMotion fastest_{};
  double fastest_side_ = 1;
};

}  // namespace articula
