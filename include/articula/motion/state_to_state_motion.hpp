// SPDX-License-Identifier: Apache-2.0
/// @file The fastest motion of one joint from any state to any other, and slower ones.
#pragma once

#include "articula/motion/braking_motion.hpp"
#include "articula/motion/furthest_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace articula {

/// Motions of one joint from a state (position, velocity, acceleration) to another one within
/// limits of velocity, acceleration and jerk. They are the fastest motion, and one of each longer
/// possible duration [Berscheid, Kröger 2021].
///
/// All motions of duration T between two velocities and accelerations form a convex set. So their
/// distances form an interval from D-(T) to D+(T), whose ends belong to two known motions
/// (FurthestMotion). A motion over the distance D can take T if D-(T) <= D <= D+(T). The fastest
/// motion is the shortest solution of D-(T) = D or D+(T) = D. A slower motion is the mixture of the
/// two furthest motions that covers D. It keeps all limits because the set is convex.
///
/// A motion that starts outside the limits begins with braking_motion(). So does a motion whose
/// velocity would pass its limit while the acceleration fades, unless it reaches the target before.
class StateToStateMotion {
 public:
  StateToStateMotion() = default;

  /// @param start, target  the states; finite
  /// @param bounds         limits that validate() accepts
  /// Real-time: yes.
  StateToStateMotion(const JointMotion& start, const JointMotion& target,
                     const MotionBounds& bounds) noexcept
      : target_(without_rounding(target, target.position, bounds)), bounds_(bounds) {
    const JointMotion from = without_rounding(start, target.position, bounds);
    starts_ = {limit_acceleration(from, bounds), braking_motion(from, bounds)};
    const double J = bounds.jerk, low = bounds.lowest_velocity, high = bounds.highest_velocity;
    // Backwards in time, the target's velocity must keep its limits while its acceleration fades.
    const double a = target_.acceleration, v = target_.velocity, bend = a / 2 / J * std::abs(a);
    if (!within(bounds.lowest_acceleration, a, bounds.highest_acceleration) ||
        !within(low, v, high) || !within(low, v - bend, high)) {
      return;
    }
    const bool is_fast = !within(low, starts_[0].end().velocity, high);
    const bool is_viable = starts_[1].size() == starts_[0].size();
    for (std::size_t way = is_fast ? 1 : 0; way < (is_viable ? 1 : 2); ++way) {
      const bool is_better = !exists();
      for (const double side : {1.0, -1.0}) {
        furthest(side, way).for_each_solution([&](const detail::FurthestMotion& motion) {
          const double duration = starts_[way].duration() + motion.duration() / J;
          solutions_.add(duration);
          if (!is_better || !(duration < least_duration_)) return;
          least_duration_ = duration;
          fastest_ = motion;
          fastest_side_ = side;
          fastest_way_ = way;
        });
      }
    }
  }

  /// Whether there is a motion to the target. Real-time: yes.
  [[nodiscard]] bool exists() const noexcept { return solutions_.size > 0; }

  /// The duration of the fastest motion [s]; infinity if there is none. Real-time: yes.
  [[nodiscard]] double least_duration() const noexcept { return least_duration_; }

  /// Whether there is a motion of a duration [s]. Some states have gaps between their durations: a
  /// joint that passes through the target may have to turn around to arrive later.
  /// Real-time: yes.
  [[nodiscard]] bool can_take(double duration) const noexcept {
    if (std::find(solutions_.begin(), solutions_.end(), duration) != solutions_.end()) return true;
    Mixture mixture;
    return duration > least_duration_ && find(duration, mixture);
  }

  /// The end of the gap that contains a duration [s]; infinity if there is none. Real-time: yes.
  [[nodiscard]] double next_duration(double duration) const noexcept {
    double next = std::numeric_limits<double>::infinity();
    for (const double solution : solutions_) {
      if (solution > duration && !(solution >= next)) next = solution;
    }
    return next;
  }

  /// The motion of a duration for which can_take() is true; of the least duration for a shorter
  /// one. Real-time: yes.
  [[nodiscard]] TransferMotion motion(double duration) const noexcept {
    Mixture mixture{fastest_, fastest_, fastest_side_ > 0 ? 1.0 : 0.0, fastest_way_};
    if (duration > least_duration_) static_cast<void>(find(duration, mixture));
    TransferMotion result = starts_[mixture.way];
    append(result, mixture);
    result.end_at(target_, std::max(duration, least_duration_));
    return result;
  }

 private:
  /// A state in which numbers that are 0 but for rounding are 0: products of six such numbers would
  /// underflow. The bound is 1e-15 of the limits, the rounding of numbers of their size. Distances
  /// have the scale of the distance on which the joint reaches its limits.
  [[nodiscard]] static JointMotion without_rounding(const JointMotion& state, double target,
                                                    const MotionBounds& b) noexcept {
    constexpr double rounding = 1e-15;
    const auto cleared = [](double x, double scale) {
      return std::abs(x) <= rounding * scale ? 0.0 : x;
    };
    const double V = std::min(-b.lowest_velocity, b.highest_velocity);
    const double A = std::min(-b.lowest_acceleration, b.highest_acceleration), J = b.jerk;
    const double length = std::min(V * std::sqrt(V / J), A / J * (A / J) * A);
    const bool is_there = std::abs(state.position - target) <= rounding * length;
    return {is_there ? target : state.position, cleared(state.velocity, std::min(V, A / J * A)),
            cleared(state.acceleration, std::min(A, std::sqrt(V * J)))};
  }
  [[nodiscard]] static bool within(double low, double x, double high) noexcept {
    const double rounding = 1e-12 * (high - low);
    return x >= low - rounding && x <= high + rounding;
  }

  /// share * up + (1 - share) * down, after one of the two initial motions.
  struct Mixture {
    detail::FurthestMotion up{}, down{};
    double share = 0;
    std::size_t way = 0;
  };

  /// The problem in the unit of time in which the jerk is 1, mirrored for side -1.
  [[nodiscard]] detail::FurthestMotions furthest(double side, std::size_t way) const noexcept {
    const JointMotion& from = starts_[way].end();
    const double J = bounds_.jerk, v0 = side * J * from.velocity, v1 = side * J * target_.velocity;
    const double a0 = side * from.acceleration, a1 = side * target_.acceleration;
    const double distance = side * J * J * (target_.position - from.position);
    const bool up = side > 0;
    const double lowest = up ? bounds_.lowest_acceleration : -bounds_.highest_acceleration;
    const double highest = up ? bounds_.highest_acceleration : -bounds_.lowest_acceleration;
    const double slowest = J * (up ? bounds_.lowest_velocity : -bounds_.highest_velocity);
    const double fastest = J * (up ? bounds_.highest_velocity : -bounds_.lowest_velocity);
    // Rounding of the positions, and of a clock that shows an hour: a picosecond.
    const double distance_rounding =
        1e-14 * J * J * (std::abs(target_.position) + std::abs(from.position)) +
        1e-12 * J * J * (std::abs(from.velocity) + std::abs(target_.velocity));
    // Rounding may put a state at a limit slightly beyond it: the limit is widened.
    const double rounding = 1e-11 * (fastest - slowest);
    const auto widened = [&](double limit, double side_of_it, double a, double v) {
      const double reached = std::max(side_of_it * v, side_of_it * v + a * std::abs(a) / 2);
      const double beyond = reached - side_of_it * limit;
      return beyond > 0 && beyond <= rounding ? side_of_it * reached : limit;
    };
    return detail::FurthestMotions(
        {.v0 = v0,
         .a0 = a0,
         .v1 = v1,
         .a1 = a1,
         .lowest_acceleration = std::min({lowest, a0, a1}),
         .highest_acceleration = std::max({highest, a0, a1}),
         .lowest_velocity = std::min(widened(slowest, -1, -a0, v0), widened(slowest, -1, a1, v1)),
         .highest_velocity = std::max(widened(fastest, 1, a0, v0), widened(fastest, 1, -a1, v1)),
         .distance = distance,
         .distance_rounding = distance_rounding});
  }

  /// Finds the two furthest motions of a duration, and the mixture that reaches the target.
  /// @return whether they exist
  [[nodiscard]] bool find(double duration, Mixture& mixture) const noexcept {
    return mix(duration, 0, mixture) || mix(duration, 1, mixture);
  }
  [[nodiscard]] bool mix(double duration, std::size_t way, Mixture& mixture) const noexcept {
    const double J = bounds_.jerk, scaled = J * (duration - starts_[way].duration());
    Mixture found{.way = way};
    if (!furthest(1, way).of_duration(scaled, found.up) ||
        !furthest(-1, way).of_duration(scaled, found.down)) {
      return false;
    }
    const double distance = J * J * (target_.position - starts_[way].end().position);
    const double most = found.up.distance(), least = -found.down.distance();
    const double rounding = 1e-11 * (found.up.length + found.down.length);
    if (distance > most + rounding || distance < least - rounding) return false;
    found.share = most > least ? std::clamp((distance - least) / (most - least), 0.0, 1.0) : 0.5;
    mixture = found;
    return true;
  }

  /// Appends a mixture to its initial motion.
  void append(TransferMotion& motion, const Mixture& mixture) const noexcept {
    const auto& [up, down, share, way] = mixture;
    const double J = bounds_.jerk, left = 1 - share, start = starts_[way].end().position;
    const double duration = share > 0 ? up.duration() : down.duration();
    const double a0 = starts_[way].end().acceleration;  // beyond a limit by rounding at most
    const double lowest = std::min(bounds_.lowest_acceleration, a0);
    const double highest = std::max(bounds_.highest_acceleration, a0);
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
      const auto u = up.at(i, next), d = down.at(k, next);
      const double a = share * u.acceleration - left * d.acceleration;
      motion.end_at({start + (share * u.position - left * d.position) / J / J,
                     (share * u.velocity - left * d.velocity) / J, std::clamp(a, lowest, highest)});
      time = next;
    }
  }

  JointMotion target_{};
  MotionBounds bounds_{};
  /// Initial motions: the second one also brings the velocity back within its limit
  std::array<TransferMotion, 2> starts_{};
  RootList<128> solutions_{};
  double least_duration_ = std::numeric_limits<double>::infinity();
  detail::FurthestMotion fastest_{};
  double fastest_side_ = 1;
  std::size_t fastest_way_ = 0;
};

}  // namespace articula
