// SPDX-License-Identifier: Apache-2.0
/// @file Scripted faults of mock hardware.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace articula {

/// The kind of a fault of mock hardware.
enum class MockFaultKind : unsigned char {
  refuses_activation,  ///< activate() returns Status::hardware_fault.
  fails_to_read,       ///< read() returns Status::hardware_fault and keeps the state.
  fails_to_write,      ///< write() returns Status::hardware_fault, and the joints stay.
  goes_silent,         ///< read() returns Status::stale_state with the joint's last figures.
  measures_nan,        ///< The joint's measured position is NaN.
  measures_position,   ///< The joint's measured position is `value`.
  measures_velocity,   ///< The joint's measured velocity is `value`.
};

/// A fault of mock hardware at some readings. Readings count from 0; a Loop makes the first in its
/// constructor. A write belongs to the reading before it.
struct MockFault {
  MockFaultKind kind{};
  std::uint64_t first = 0;                                          ///< reading of its begin
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();  ///< number of readings
  int joint = -1;    ///< index of the joint; -1: all joints
  double value = 0;  ///< measured instead [rad or m, rad/s or m/s]

  /// Real-time: yes.
  [[nodiscard]] constexpr bool covers(std::uint64_t reading) const noexcept {
    return reading >= first && reading - first < count;
  }
};

/// Checks a script and the period.
/// @param script       the faults
/// @param joint_count  of the robot
/// @param period       of the hardware [s]
/// @throws std::invalid_argument with the fault, the value and the limit
/// Real-time: no (throws).
inline void validate(const std::vector<MockFault>& script, int joint_count, double period) {
  if (!is_finite(period) || period <= 0) {
    detail::refuse({"mock hardware: period ", period, " s is not a positive number"});
  }
  for (std::size_t i = 0; i < script.size(); ++i) {
    if (script[i].joint < -1 || script[i].joint >= joint_count) {
      detail::refuse({"mock hardware: fault ", i, ": joint ", script[i].joint,
                      " is not between -1 and ", joint_count - 1});
    }
  }
}

}  // namespace articula
