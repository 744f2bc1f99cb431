// SPDX-License-Identifier: Apache-2.0
/// @file The stability of a joint under a law that is computed once per period.
#pragma once

#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/finite.hpp"
#include "articula/tuning/held_effort.hpp"

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace articula {

/// The spectral radius of a joint under a law that is computed at the beginning of each period dt and
/// whose output is held until its end. The joint moves as in detail::HeldEffort, the law for y = q or
/// v as JointPid does with a reference of 0. Together they multiply the state (q, v, D, y_last, I) by
/// one matrix A per period. Its spectral radius r is the limit of |A^n|^(1/n), taken here by squaring
/// A 40 times: deviations from the reference grow as r^n.
/// Source: [Åström, Wittenmark 1997, section 3.2].
/// @param plant     I and T
/// @param feedback  the law
/// @param period    dt > 0 [s]
/// @return          r; below 1 the joint comes to rest, above 1 it does not, at 1 nothing holds its
///                  position. Infinity on overflow.
/// Real-time: no (set-up).
[[nodiscard]] inline double spectral_radius(const JointPlant& plant,
                                            const SampledFeedback& feedback, double period) {
  using Row = Eigen::Matrix<double, 1, 5>;
  enum { position, velocity, rate, last, sum };
  // The unit of time is dt and that of the output is I/dt^2.
  const detail::HeldEffort held(plant, period);
  const double unit = (feedback.of_velocity ? period : period * period) / plant.inertia;
  const double p = feedback.proportional * unit, d = feedback.derivative / period * unit;
  const double i = feedback.integral * period * unit;

  const auto only = [](int state) -> Row { return Row::Unit(state); };
  const Row y = only(feedback.of_velocity ? velocity : position);
  const bool differences = feedback.of_velocity || feedback.takes_differences;
  const Row slope = differences ? Row(only(last) - y) : Row(-only(velocity));
  const double share = period / (feedback.filter_time + period);
  const Row filtered = only(rate) + share * (slope - only(rate));
  const Row integral = i != 0 ? Row(only(sum) - i * y) : Row(Row::Zero());
  const Row used = i != 0 && feedback.integral_lags ? only(sum) : integral;
  const Row output = -p * y + used + d * filtered;

  Eigen::Matrix<double, 5, 5> power;
  // A law of the velocity does not depend on the position.
  power.row(position) = feedback.of_velocity
                            ? Row(Row::Zero())
                            : Row(only(position) + held.f1 * only(velocity) + held.f2 * output);
  power.row(velocity) = held.decay * only(velocity) + held.f1 * output;
  power.row(rate) = filtered;
  power.row(last) = y;
  power.row(sum) = integral;

  double logarithm = 0;  // of |A^n|^(1/n)
  for (double n = 1; n < 1e12; n *= 2) {
    const double size = power.norm();
    if (size == 0) return 0;
    if (!is_finite(size)) return std::numeric_limits<double>::infinity();
    logarithm += std::log(size) / n;
    power = (power / size * (power / size)).eval();
  }
  return std::exp(logarithm);
}

}  // namespace articula
