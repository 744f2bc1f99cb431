// SPDX-License-Identifier: Apache-2.0
/// @file A joint under a law that is computed once in every period.
#pragma once

#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/finite.hpp"
#include "articula/tuning/joint_plant.hpp"

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace articula {

/// The spectral radius of a joint under a law that is computed at the beginning of each period dt,
/// and whose output u is held for the length of it. The joint, I q'' + D q' = u, goes exactly, with
/// x = dt/T = dt D/I, as
///
///     q <- q + f1 dt v + f2 dt^2/I u     f1 = (1 - exp(-x))/x,   1   for x = 0
///     v <- exp(-x) v + f1 dt/I u         f2 = (1 - f1)/x,        1/2 for x = 0
///
/// and the law, for y = q or v, as JointPid does with a reference of 0. Together they multiply the
/// state (q, v, D, y_last, I) by one matrix A per period. Its spectral radius r is the limit of
/// |A^n|^(1/n), taken here by squaring A 40 times: deviations from the reference grow as r^n.
/// Source: [Åström, Wittenmark 1997, sections 2.3 and 3.2].
/// @param plant     I and T
/// @param feedback  the law
/// @param period    dt > 0 [s]
/// @return          r; above 1 the joint never comes to rest, below 1 it does. 1: nothing holds its
///                  position. Infinity: beyond numbers
/// Real-time: no (set-up).
[[nodiscard]] inline double spectral_radius(const JointPlant& plant,
                                            const SampledFeedback& feedback, double period) {
  using Row = Eigen::Matrix<double, 1, 5>;
  enum { position, velocity, rate, last, sum };
  // The unit of time is dt and that of the output is I/dt^2.
  const double x = period * plant.decay_rate();
  const double f1 = x > 0 ? -std::expm1(-x) / x : 1;
  // Below 1e-3 the difference has lost 1e-10, and what the series leaves out is less.
  const double f2 = x > 1e-3 ? (1 - f1) / x : 1.0 / 2 - x / 6 + x * x / 24;
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
  // A law of the velocity does not know where the joint is.
  power.row(position) = feedback.of_velocity
                            ? Row(Row::Zero())
                            : Row(only(position) + f1 * only(velocity) + f2 * output);
  power.row(velocity) = std::exp(-x) * only(velocity) + f1 * output;
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
