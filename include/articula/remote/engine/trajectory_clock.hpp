// SPDX-License-Identifier: Apache-2.0
/// @file The time of a trajectory beside that of its loop.
#pragma once

#include "articula/core/finite.hpp"

#include <limits>

namespace articula::remote {

/// How the time of a trajectory runs at the moment.
struct TrajectoryClock {
  double loop_time = 0;                                    ///< the present of the loop [s]
  double time = std::numeric_limits<double>::quiet_NaN();  ///< that of the trajectory [s]
  double speed = 1;                                        ///< trajectory's time per loop's time

  /// False before the trajectory's start and after its end. Real-time: yes.
  [[nodiscard]] bool runs() const noexcept { return is_finite(time); }
  /// The trajectory's time at a time of the loop, at the present speed [s]. Real-time: yes.
  [[nodiscard]] double at(double other) const noexcept {
    return time + speed * (other - loop_time);
  }
};

}  // namespace articula::remote
