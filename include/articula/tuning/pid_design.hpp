// SPDX-License-Identifier: Apache-2.0
/// @file Gains from a crossover frequency and a phase margin.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/tuning/joint_plant.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

namespace articula {

/// The required crossover and phase margin of a control loop.
struct LoopTarget {
  double crossover = 0;                        ///< w_c, where |L| = 1 [rad/s], > 0
  double phase_margin = std::numbers::pi / 3;  ///< at w_c [rad], within 0 .. pi
  double delay = 0;  ///< from measurement to effort, half a period if it is held [s], >= 0
};

namespace detail {

/// C(j w_c) = real + j imaginary, which gives the loop gain the value exp(j (phase_margin - pi)).
struct ControllerValue {
  double real = 0;       ///< p
  double imaginary = 0;  ///< d w_c - i/w_c
};

/// The value of the controller at the crossover frequency: its size is 1/|P|, its phase is
/// phase_margin - pi/2 + atan(w_c T) + w_c delay.
/// @param kind       of the controller, for the message
/// @param low, high  limits of its phase, both excluded [rad]
[[nodiscard]] inline ControllerValue controller_at_crossover(const JointPlant& plant,
                                                             const LoopTarget& target,
                                                             std::string_view kind, double low,
                                                             double high) {
  validate(plant);
  const auto& [w, margin, delay] = target;
  if (!is_finite(w) || !(w > 0)) {
    refuse({"loop target: crossover ", w, " rad/s is not a finite number > 0"});
  }
  if (!is_finite(margin) || !(margin > 0 && margin < std::numbers::pi)) {
    refuse({"loop target: phase_margin ", margin, " rad is not within 0 .. pi"});
  }
  if (!is_finite(delay) || delay < 0) {
    refuse({"loop target: delay ", delay, " s is not a finite number >= 0"});
  }
  const double alone =  // the phase margin with a proportional gain alone
      std::numbers::pi / 2 - std::atan2(w, plant.decay_rate()) - w * delay;
  const double phase = margin - alone;
  if (!(phase > low && phase < high)) {
    refuse({"loop target: a ", kind, " with its crossover at ", w,
            " rad/s has a phase margin between ", alone + low, " and ", alone + high, " rad, not ",
            margin, " rad"});
  }
  const double size = plant.inertia * w * std::hypot(w, plant.decay_rate());
  if (!is_finite(size) || !(size > 0)) {
    refuse({"loop target: at the crossover ", w, " rad/s a gain of ", size, " would be needed"});
  }
  return {size * std::cos(phase), size * std::sin(phase)};
}

/// @throws std::invalid_argument if a gain has overflowed
[[nodiscard]] inline PidGains designed_gains(double p, double i, double d) {
  const PidGains gains{.proportional = p, .integral = i, .derivative = d};
  if (!is_finite(p) || !is_finite(i) || !is_finite(d)) {
    refuse({"loop target: gains of ", p, ", ", i, " and ", d, " would be needed"});
  }
  return gains;
}

}  // namespace detail

/// The gains of a PID for a joint. At the crossover frequency w the controller must have the phase
/// phi and the size K,
///
///     phi = phase_margin - pi/2 + atan(w T) + w delay,   K = 1/|P(j w)| = I w sqrt(w^2 + 1/T^2),
///
/// so that p = K cos phi and d w - i/w = K sin phi. The third condition is the ratio r of the
/// integral time p/i to the derivative time d/p:
///
///     d/p = x/w,   p/i = r x/w,   x = (tan phi + sqrt(tan^2 phi + 4/r))/2.
///
/// r = 4 gives the controller two equal real zeros and is the ratio of Ziegler and Nichols. A
/// larger one gives less integral and derivative action, less overshoot and slower correction of
/// steady errors. For r >= 2 there is no second crossover, and the closed loop is stable.
/// Source: [Åström, Murray 2021, chapter 12], for this plant.
/// @param plant       the joint
/// @param target      crossover and phase margin
/// @param time_ratio  r [1], >= 2
/// @return            p, i and d; set the clamps of the integral to the drive's limits
/// @throws std::invalid_argument naming the parameter, its value and the limit, if one is out of
///         range or this phase margin is impossible at this crossover frequency
/// Real-time: no (set-up).
[[nodiscard]] inline PidGains design_pid(const JointPlant& plant, const LoopTarget& target,
                                         double time_ratio = 4) {
  if (!is_finite(time_ratio) || time_ratio < 2) {
    detail::refuse({"loop target: time_ratio ", time_ratio, " is not a finite number >= 2"});
  }
  constexpr double quarter = std::numbers::pi / 2;
  const auto [p, rest] = detail::controller_at_crossover(plant, target, "PID", -quarter, quarter);
  // x, and 1/(r x) as the other root, so that neither is a difference of nearly equal numbers.
  const double half = rest / p / 2, root = std::hypot(half, 1 / std::sqrt(time_ratio));
  const double larger = std::abs(half) + root, smaller = 1 / time_ratio / larger;
  const double derivative = half > 0 ? larger : smaller, integral = half > 0 ? smaller : larger;
  return detail::designed_gains(p, p * integral * target.crossover,
                                p * derivative / target.crossover);
}

/// The gains of a PI: p = K cos phi, i = -w K sin phi with phi and K of design_pid. An integral
/// term reduces the phase, -pi/2 < phi < 0, so the phase margin is less than that of a proportional
/// gain alone. The closed loop is stable.
/// @throws std::invalid_argument as design_pid
/// Real-time: no (set-up).
[[nodiscard]] inline PidGains design_pi(const JointPlant& plant, const LoopTarget& target) {
  const auto [p, rest] =
      detail::controller_at_crossover(plant, target, "PI", -std::numbers::pi / 2, 0);
  return detail::designed_gains(p, -rest * target.crossover, 0);
}

/// The gains of a PD: p = K cos phi, d = K sin phi/w with phi and K of design_pid. A derivative
/// term adds phase, 0 < phi < pi/2, so the phase margin exceeds that of a proportional gain alone.
/// The closed loop is stable.
/// @throws std::invalid_argument as design_pid
/// Real-time: no (set-up).
[[nodiscard]] inline PidGains design_pd(const JointPlant& plant, const LoopTarget& target) {
  const auto [p, rest] =
      detail::controller_at_crossover(plant, target, "PD", 0, std::numbers::pi / 2);
  return detail::designed_gains(p, 0, rest / target.crossover);
}

}  // namespace articula
