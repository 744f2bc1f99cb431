// SPDX-License-Identifier: Apache-2.0
/// @file The stability of a joint under a law that is computed once per period.
#pragma once

#include "articula/control/laws/sampled_feedback.hpp"
#include "articula/core/finite.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/tuning/joint_plant.hpp"

#include <cmath>
#include <limits>

namespace articula {

/// The spectral radius of a joint under a law. The law is computed at the beginning of each period
/// dt, and its output is held until the end of the period. The joint moves as in
/// detail::HeldEffort. The law is computed for y = q or v, as JointPid does with a reference of 0.
/// Together they multiply the state (q, v, D, y_last, I) by one matrix A per period. Its spectral
/// radius r is the limit of |A^n|^(1/n), taken here by squaring A 40 times: deviations from the
/// reference grow as r^n.
/// Source: [Åström, Wittenmark 1997, section 3.2].
/// @param plant     I and T
/// @param feedback  the law
/// @param period    dt > 0 [s]
/// @return          r; below 1 the joint comes to rest, above 1 it does not, at 1 nothing holds its
///                  position. Infinity on overflow.
/// Real-time: no (set-up).
[[nodiscard]] inline double spectral_radius(const JointPlant& plant,
                                            const SampledFeedback& feedback, double period) {
  using Row = JointArray<double, 5>;  // Eigen's expressions would take longer to compile
  constexpr int position = 0, velocity = 1, rate = 2, last = 3, sum = 4;
  // The unit of time is dt and that of the output is I/dt^2.
  const detail::HeldEffort held(plant, period);
  const double unit = (feedback.of_velocity ? period : period * period) / plant.inertia;
  const double p = feedback.proportional * unit, d = feedback.derivative / period * unit;
  const double i = feedback.integral * period * unit;

  const Row zero{};
  const auto plus = [](Row result, double factor, const Row& row) {
    for (int k = 0; k < 5; ++k) result[k] += factor * row[k];
    return result;
  };
  const auto only = [](int state) {
    Row row{};
    row[state] = 1;
    return row;
  };
  const Row y = only(feedback.of_velocity ? velocity : position);
  const bool differences = feedback.of_velocity || feedback.takes_differences;
  const Row slope = differences ? plus(only(last), -1, y) : plus(zero, -1, only(velocity));
  const double share = period / (feedback.filter_time + period);
  const Row filtered = plus(only(rate), share, plus(slope, -1, only(rate)));
  const Row integral = i != 0 ? plus(only(sum), -i, y) : zero;
  const Row used = i != 0 && feedback.integral_lags ? only(sum) : integral;
  const Row output = plus(plus(used, -p, y), d, filtered);

  JointArray<Row, 5> power{};
  // A law of the velocity does not depend on the position.
  if (!feedback.of_velocity) {
    power[position] = plus(plus(only(position), held.f1, only(velocity)), held.f2, output);
  }
  power[velocity] = plus(plus(zero, held.decay, only(velocity)), held.f1, output);
  power[rate] = filtered;
  power[last] = y;
  power[sum] = integral;

  double logarithm = 0;  // of |A^n|^(1/n)
  for (double n = 1; n < 1e12; n *= 2) {
    double square = 0;
    for (const Row& row : power) {
      for (const double x : row) square += x * x;
    }
    const double size = std::sqrt(square);
    if (size == 0) return 0;
    if (!is_finite(size)) return std::numeric_limits<double>::infinity();
    logarithm += std::log(size) / n;
    for (Row& row : power) {
      for (double& x : row) x /= size;
    }
    JointArray<Row, 5> next{};
    for (int j = 0; j < 5; ++j) {
      for (int k = 0; k < 5; ++k) next[j] = plus(next[j], power[j][k], power[k]);
    }
    power = next;
  }
  return std::exp(logarithm);
}

}  // namespace articula
