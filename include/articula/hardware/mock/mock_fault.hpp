// SPDX-License-Identifier: Apache-2.0
/// @file What goes wrong with hardware that is not there.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace articula {

/// How mock hardware fails.
enum class MockFaultKind : unsigned char {
  refuses_activation,  ///< activate() answers Status::hardware_fault.
  fails_to_read,       ///< read() answers Status::hardware_fault and leaves the state alone.
  fails_to_write,      ///< write() answers Status::hardware_fault and the joints do not follow.
  goes_silent,         ///< read() answers Status::stale_state with the joint's last figures.
  measures_nan,        ///< The joint's measured position is NaN.
  measures_position,   ///< The joint's measured position is `value`.
  measures_velocity,   ///< The joint's measured velocity is `value`.
};

/// Something that goes wrong with mock hardware, at some readings. Readings are counted from 0; a
/// Loop makes the first when it is constructed. A write belongs to the reading before it.
struct MockFault {
  MockFaultKind kind{};
  std::uint64_t first = 0;                                          ///< reading at which it begins
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();  ///< for so many readings
  int joint = -1;    ///< index of the joint it happens to; -1: to all of them
  double value = 0;  ///< what is measured instead [rad or m, rad/s or m/s]

  /// Real-time: yes.
  [[nodiscard]] constexpr bool covers(std::uint64_t reading) const noexcept {
    return reading >= first && reading - first < count;
  }
};

/// Refuses a script that makes no sense.
/// @param script       the faults
/// @param joint_count  of the robot
/// @param period       of the hardware [s]
/// @throws std::invalid_argument naming the fault, the value and the limit
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
