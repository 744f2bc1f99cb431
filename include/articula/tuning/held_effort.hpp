// SPDX-License-Identifier: Apache-2.0
/// @file The exact motion of a joint whose effort is held for a period.
#pragma once

#include "articula/tuning/joint_plant.hpp"

#include <cmath>

namespace articula::detail {

/// I q'' + (I/T) q' = effort over a period h of constant effort, with x = h/T:
///
///     q <- q + f1 h v + f2 h^2 effort/I     f1 = (1 - exp(-x))/x,   1   for x = 0
///     v <- decay v + f1 h effort/I          f2 = (1 - f1)/x,        1/2 for x = 0
///
/// Source: [Åström, Wittenmark 1997, section 2.3].
struct HeldEffort {
  double inertia, period;
  double decay;  ///< exp(-x)
  double f1 = 1, f2;

  HeldEffort(const JointPlant& plant, double held_period)
      : inertia(plant.inertia), period(held_period) {
    const double x = period * plant.decay_rate();
    decay = std::exp(-x);
    if (x > 0) f1 = -std::expm1(-x) / x;
    // Below 1e-3 the difference 1 - f1 cancels; the series leaves out less than 1e-15.
    f2 = x > 1e-3 ? (1 - f1) / x : (1 - x / 3 * (1 - x / 4 * (1 - x / 5))) / 2;
  }

  /// Moves a joint over one period.
  void advance(double& position, double& velocity, double effort) const {
    const double push = period * effort / inertia;
    position += period * (f1 * velocity + f2 * push);
    velocity = decay * velocity + f1 * push;
  }
};

}  // namespace articula::detail
