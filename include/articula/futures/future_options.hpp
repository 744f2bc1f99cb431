// SPDX-License-Identifier: Apache-2.0
/// @file The number, length and spread of simulated futures.
#pragma once

#include "articula/core/refuse.hpp"

#include <cstdint>
#include <string_view>

namespace articula {

/// How far simulated robots may differ from the described one. Each robot draws its own numbers,
/// all equally probable within these bounds. All 0: no difference.
struct FutureSpread {
  double mass = 0.2;             ///< of each body's mass and inertia, relative to it, 0 .. 0.9 [1]
  double friction = 0.2;         ///< of each joint's damping and dry friction, relative, 0 .. 1 [1]
  int delay = 1;                 ///< highest delay of the command, 0 .. 100 [cycles]
  double position_noise = 1e-4;  ///< standard deviation, 0 .. 1 [rad or m]
  double velocity_noise = 1e-3;  ///< standard deviation, 0 .. 1 [rad/s or m/s]
};

/// What to simulate.
struct FutureOptions {
  FutureSpread spread{};
  std::uint64_t seed = 1;  ///< the same seed gives the same futures, to the last bit
  int count = 100;         ///< of futures, 1 .. 1000
  double horizon = 1;      ///< simulated time, at least a period, at most 10 s [s]
  int samples = 50;        ///< of each trajectory beside its start, 1 .. 1000
};

/// Refuses options that cannot be simulated.
/// @param period  of the loop [s]
/// @throws std::invalid_argument naming the option, its value and what is accepted
/// Real-time: no (throws).
inline void validate(const FutureOptions& options, double period) {
  const auto check = [](std::string_view name, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return;
    detail::refuse({"futures: ", name, " ", value, " is not within ", lowest, " .. ", highest});
  };
  const FutureSpread& spread = options.spread;
  check("mass", spread.mass, 0, 0.9);
  check("friction", spread.friction, 0, 1);
  check("delay", spread.delay, 0, 100);
  check("position_noise", spread.position_noise, 0, 1);
  check("velocity_noise", spread.velocity_noise, 0, 1);
  check("count", options.count, 1, 1000);
  check("samples", options.samples, 1, 1000);
  check("horizon", options.horizon, period, 10);
}

}  // namespace articula
