// SPDX-License-Identifier: Apache-2.0
/// @file The motions of one joint that cover the largest distance in a given time.
#pragma once

#include "articula/motion/polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace articula::detail {

/// The jerks of the stretches of a FurthestMotion.
inline constexpr std::array<double, 7> furthest_jerks{1, 0, -1, 0, -1, 0, 1};

/// A motion from one velocity and acceleration to others that covers the largest distance in its
/// time. The jerk is 1. The acceleration rises from a_0 to A, stays there, falls to B, stays there,
/// and rises to a_1. Where it passes zero on its fall, the joint cruises. Any of these stretches
/// may take no time. Values known exactly at a moment are stored, so that rounding does not
/// accumulate.
struct FurthestMotion {
  /// The motion at the beginning of a stretch.
  struct Moment {
    double time = 0, position = 0, velocity = 0, acceleration = 0;
  };
  std::array<Moment, 8> moments{};  ///< the beginnings of seven stretches, and the end
  double length = 0;                ///< of the path, in both directions

  [[nodiscard]] double duration() const noexcept { return moments[7].time; }
  [[nodiscard]] double distance() const noexcept { return moments[7].position; }

  /// The motion at a time in a stretch.
  [[nodiscard]] Moment at(std::size_t stretch, double time) const noexcept {
    if (time == moments[stretch + 1].time) return moments[stretch + 1];
    const Moment& m = moments[stretch];
    const double t = time - m.time, j = furthest_jerks[stretch];
    return {time, m.position + t * (m.velocity + t * (m.acceleration / 2 + t * (j / 6))),
            m.velocity + t * (m.acceleration + t * (j / 2)), m.acceleration + t * j};
  }
};

/// All furthest motions between two states of velocity and acceleration within limits. The unit of
/// time is such that the jerk is 1.
///
/// On a stretch with jerk +1 v = c + a^2/2 holds, with the constants c_0 = v_0 - a_0^2/2 before A
/// and c_1 = v_1 - a_1^2/2 after B; with jerk -1 v = P - a^2/2. So the times at A and at B are
/// (P - c_0 - A^2)/A and (P - c_1 - B^2)/(-B), and the distance is
///
///     K + c_0 A - c_1 B + P (A - B) + ((P - A^2/2)^2 - (c_0 + A^2/2)^2)/(2 A)
///       + ((c_1 + B^2/2)^2 - (P - B^2/2)^2)/(2 B) + V t_cruise,
///     K = c_1 a_1 - c_0 a_0 + (a_1^3 - a_0^3)/6.
///
/// There are five kinds, depending on which of A, B and P are at their limits. Each has one free
/// parameter. The distance is a polynomial of degree four at most in it (times the parameter in the
/// first kind). The duration is monotonic, linear or quadratic.
class FurthestMotions {
 public:
  /// Both states, and the limits of velocity and acceleration, in the unit of time of jerk 1.
  struct Problem {
    double v0 = 0, a0 = 0, v1 = 0, a1 = 0;
    double lowest_acceleration = 0, highest_acceleration = 0;
    double lowest_velocity = 0, highest_velocity = 0;
    double distance = 0;           ///< to cover
    double distance_rounding = 0;  ///< rounding of the positions whose difference it is
  };

  explicit FurthestMotions(const Problem& problem) noexcept
      : p_(problem),
        c0_(problem.v0 - problem.a0 * problem.a0 / 2),
        c1_(problem.v1 - problem.a1 * problem.a1 / 2),
        K_(c1_ * problem.a1 - c0_ * problem.a0 +
           (problem.a1 * problem.a1 * problem.a1 - problem.a0 * problem.a0 * problem.a0) / 6) {}

  /// Calls `found(motion)` for each motion that covers the distance of the problem.
  /// Real-time: yes.
  template <class Found>
  void for_each_solution(Found found) const noexcept {
    const double A = p_.highest_acceleration, B = p_.lowest_acceleration;
    const double V = p_.highest_velocity, D = p_.distance, C = c1_ - c0_;
    FurthestMotion motion;
    const auto offer = [&](bool exists) {
      const double off = std::abs(motion.distance() - D);
      if (exists && off <= p_.distance_rounding + rounding * motion.length) found(motion);
    };
    // A and B free: A - B = q, A + B = C/q
    const auto neither_at = [&](double q) { offer(neither(q, motion)); };
    const std::array<double, 5> f{-C * C, 4 * (K_ - D), 4 * (c0_ + c1_), 0, 1};
    for (const double q : roots_and_turns(f, 0, A - B)) neither_at(q);
    for (const double side : {1.0, -1.0}) {  // where the first or the last stretch takes no time
      neither_at(p_.a0 + side * std::sqrt(std::max(0.0, p_.a0 * p_.a0 - C)));
      neither_at(-p_.a1 + side * std::sqrt(std::max(0.0, p_.a1 * p_.a1 + C)));
    }
    neither_at(p_.a0 - p_.a1);
    // One stretch alone: jerk 1 from a_0 to a_1
    offer(make(p_.a1, p_.a1, c1_ + p_.a1 * p_.a1, 0, motion, true));
    // A at its limit
    const auto high_at = [&](double b) { offer(at_highest(b, motion)); };
    const double u = c1_ - A * A / 2, w = c0_ + A * A / 2;
    const double g0 = K_ + c0_ * A + c1_ * A + (u * u - w * w) / (2 * A) - D;
    const std::array<double, 5> g{g0, -2 * c1_, A / 2 + c1_ / A, -1, 1 / (2 * A)};
    for (const double b : roots_and_turns(g, B, std::min(A, p_.a1))) high_at(b);
    high_at(p_.a1);
    // B at its limit
    const auto low_at = [&](double a) { offer(at_lowest(a, motion)); };
    const double x = c1_ + B * B / 2, y = c0_ - B * B / 2;
    const double h0 = K_ - c0_ * B - c1_ * B + (x * x - y * y) / (2 * B) - D;
    const std::array<double, 5> h{h0, 2 * c0_, -B / 2 - c0_ / B, 1, -1 / (2 * B)};
    for (const double a : roots_and_turns(h, std::max(B, p_.a0), A)) low_at(a);
    low_at(p_.a0);
    // A and B at their limits
    const double k0 = K_ + c0_ * A - c1_ * B + (A * A * A * A / 4 - w * w) / (2 * A) +
                      (x * x - B * B * B * B / 4) / (2 * B) - D;
    const std::array<double, 3> k{k0, (A - B) / 2, 1 / (2 * A) - 1 / (2 * B)};
    const double least = std::max(c0_ + A * A, c1_ + B * B);
    for (const double P : roots_and_turns(k, least, std::max(least, V))) {
      offer(make(A, B, P, 0, motion));
    }
    offer(make(A, B, least, 0, motion));
    // with a cruise
    if (cruising(0, motion) && V != 0) offer(cruising((D - motion.distance()) / V, motion));
  }

  /// The motion of a given duration.
  /// @return whether it exists
  /// Real-time: yes.
  [[nodiscard]] bool of_duration(double duration, FurthestMotion& best) const noexcept {
    const double A = p_.highest_acceleration, B = p_.lowest_acceleration;
    const double C = c1_ - c0_, rest = duration - (p_.a1 - p_.a0);
    bool exists = false;
    FurthestMotion motion;
    const auto offer = [&](bool is_one) {
      const double late = std::abs(motion.duration() - duration);
      if (!is_one || late > 1e3 * rounding * duration) return;
      if (!exists || motion.distance() > best.distance()) best = motion;
      exists = true;
    };
    offer(neither(rest / 2, motion));
    offer(at_highest(A - std::sqrt(std::max(0.0, A * rest - C)), motion));
    offer(at_lowest(B + std::sqrt(std::max(0.0, C - B * rest)), motion));
    offer(make(A, B, (rest - (A - B) + c0_ / A - c1_ / B) / (1 / A - 1 / B), 0, motion));
    if (cruising(0, motion)) offer(cruising(duration - motion.duration(), motion));
    return exists;
  }

 private:
  [[nodiscard]] bool neither(double q, FurthestMotion& motion) const noexcept {
    if (!(q > 0)) return false;
    const double s = (c1_ - c0_) / q, a = (q + s) / 2, b = (s - q) / 2;
    return make(a, b, (c0_ + c1_ + a * a + b * b) / 2, 0, motion, true);
  }
  [[nodiscard]] bool at_highest(double b, FurthestMotion& motion) const noexcept {
    return make(p_.highest_acceleration, b, c1_ + b * b, 0, motion);
  }
  [[nodiscard]] bool at_lowest(double a, FurthestMotion& motion) const noexcept {
    return make(a, p_.lowest_acceleration, c0_ + a * a, 0, motion);
  }
  [[nodiscard]] bool cruising(double cruise, FurthestMotion& motion) const noexcept {
    const double V = p_.highest_velocity;
    const double a = std::sqrt(std::max(0.0, V - c0_)), b = std::sqrt(std::max(0.0, V - c1_));
    return make(std::min(a, p_.highest_acceleration), std::max(-b, p_.lowest_acceleration), V,
                cruise, motion);
  }

  /// Computes the motion with these parameters.
  /// @param is_bent  no time is spent at A and B
  /// @return         whether it exists: no duration is negative, and the limits are kept
  [[nodiscard]] bool make(double A, double B, double P, double cruise, FurthestMotion& motion,
                          bool is_bent = false) const noexcept {
    const double bend = rounding * (std::abs(A) + std::abs(B) + std::abs(p_.a0) + std::abs(p_.a1));
    const double speed = rounding * (std::abs(P) + std::abs(c0_) + std::abs(c1_) + A * A + B * B);
    if (A > p_.highest_acceleration + bend || B < p_.lowest_acceleration - bend) return false;
    const bool falls_through = A >= 0 && B <= 0;
    if (falls_through && P > p_.highest_velocity + speed) return false;
    const double lowest = p_.lowest_velocity - speed;  // where the acceleration rises through 0
    if ((p_.a0 < 0 && A > 0 && c0_ < lowest) || (B < 0 && p_.a1 > 0 && c1_ < lowest)) return false;
    const double over_high = P - c0_ - A * A, over_low = P - c1_ - B * B;
    if (is_bent && std::abs(over_high) + std::abs(over_low) > speed) return false;
    // A difference of the size of rounding takes no time: the level may be next to zero.
    const auto time_at = [&](double over, double level) {
      return is_bent || std::abs(over) <= speed / 100 ? 0.0 : over / level;
    };
    const double at_high = time_at(over_high, A), at_low = time_at(over_low, -B);
    if (!(at_high * std::abs(A) >= -speed) || !(at_low * std::abs(B) >= -speed)) return false;
    const double bottom = P - B * B / 2, middle = falls_through ? 0 : B;
    const double passing = falls_through ? P : bottom;
    const std::array<double, 7> durations{A - p_.a0,  at_high, A - middle, cruise,
                                          middle - B, at_low,  p_.a1 - B};
    motion.moments = {{{0, 0, p_.v0, p_.a0},
                       {0, 0, c0_ + A * A / 2, A},
                       {0, 0, P - A * A / 2, A},
                       {0, 0, passing, middle},
                       {0, 0, passing, middle},
                       {0, 0, bottom, B},
                       {0, 0, c1_ + B * B / 2, B},
                       {0, 0, p_.v1, p_.a1}}};
    motion.length = 0;
    for (std::size_t k = 0; k < 7; ++k) {
      const bool is_ramp = k % 2 == 0;
      const double slack = is_ramp ? bend : k == 3 ? rounding * motion.moments[3].time : 0;
      if (is_ramp || k == 3) {
        if (!(durations[k] >= -slack)) return false;
      }
      const double d = std::max(0.0, durations[k]);
      auto& [time, position, v, a] = motion.moments[k];
      const double j = furthest_jerks[k];
      motion.moments[k + 1].time = time + d;
      motion.moments[k + 1].position = position + d * (v + d * (a / 2 + d * (j / 6)));
      motion.length += d * (std::abs(v) + d * (std::abs(a) + (is_ramp ? d : 0)));
    }
    return true;
  }

  /// Rounding of sums of some products, relative to the terms.
  static constexpr double rounding = 1e-12;

  Problem p_;
  double c0_, c1_, K_;
};

}  // namespace articula::detail
