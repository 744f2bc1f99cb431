// SPDX-License-Identifier: Apache-2.0
/// @file The tolerances of a supervised loop, and its behaviour in a fault.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <limits>
#include <string_view>

namespace articula {

/// What the joints do in a fault, while their state can be trusted; where it cannot, they get what
/// safe_command gives.
enum class SafeBehaviour : unsigned char {
  hold,  ///< The controller holds the position of that moment; if it is to blame itself: damp.
  damp,  ///< Carried against gravity, the motion decays; see damping_effort. A controller that
         ///< keeps limits, as Limited does, holds instead.
  zero_effort,  ///< No effort, and zero velocity or the last position from drives that take these.
                ///< A moving arm coasts, also beyond the limits of a Limited.
};

/// What a supervised loop tolerates, and what it does when that is exceeded.
struct SupervisionOptions {
  SafeBehaviour behaviour = SafeBehaviour::damp;
  /// How long a reference holds after it was posted [s]. By default for ever, as a set-point does.
  double reference_lifetime = std::numeric_limits<double>::infinity();
  int bad_cycles = 3;  ///< so many in a row are borne with; one more is a fault
  int overruns = 10;   ///< so many within a second are borne with; one more is a fault
  double position_margin =
      0.01;  ///< beyond the joints' limits, until that is a bad cycle [rad or m]
  double velocity_margin = 0.1;  ///< likewise, as a share of the velocity limit
  double start_time = 0.1;       ///< within which a good state must come after activation [s]
  double damping_time = 0.1;     ///< T, in which the velocity falls to 1/e while damping [s]
};

/// Refuses options that make no sense.
/// @param options  of a supervised loop
/// @param period   of that loop [s]; damping faster than in two of them could overshoot
/// @throws std::invalid_argument naming the option, the value and the limit
/// Real-time: no (throws).
inline void validate(const SupervisionOptions& options, double period) {
  const auto at_least = [](std::string_view name, double value, double limit) {
    if (value >= limit) return;  // false for NaN
    detail::refuse({"supervision: ", name, " ", value, " is not at least ", limit});
  };
  at_least("bad_cycles", options.bad_cycles, 0);
  at_least("overruns", options.overruns, 0);
  at_least("position_margin", options.position_margin, 0);
  at_least("velocity_margin", options.velocity_margin, 0);
  at_least("start_time", options.start_time, 0);
  at_least("reference_lifetime", options.reference_lifetime, 0);
  at_least("damping_time", options.damping_time, 2 * period);
}

}  // namespace articula
