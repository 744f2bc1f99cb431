// SPDX-License-Identifier: Apache-2.0
/// @file How closely positions can keep limits of their differences.
#pragma once

#include <cmath>

namespace articula {

/// By how much differences of positions may pass limits of velocity, acceleration and jerk and
/// still be taken for within them: positions are rounded, by up to 1.1e-16 of their size, and then
/// divided by the period once, twice and three times. (Twice as much is allowed for who computed
/// them, by the same limits.)
struct CommandSlack {
  double velocity = 0;      ///< [rad/s or m/s]
  double acceleration = 0;  ///< [rad/s^2 or m/s^2]
  double step = 0;          ///< of the acceleration from cycle to cycle [rad/s^2 or m/s^2]

  /// None.
  CommandSlack() = default;

  /// @param position  [rad or m]
  /// @param period    dt > 0 [s]
  /// Real-time: yes.
  CommandSlack(double position, double period) noexcept
      : velocity(2e-15 * (1 + std::abs(position)) / period),
        acceleration(2 * velocity / period),
        step(2 * acceleration) {}

  /// A value, or the end of the range from low to high if it is farther beyond than the slack.
  /// Real-time: yes.
  [[nodiscard]] static double clamp(double value, double low, double high, double slack) noexcept {
    return value < low - slack ? low : value > high + slack ? high : value;
  }
};

}  // namespace articula
