// SPDX-License-Identifier: Apache-2.0
/// @file A number in the whole units of a frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace articula {

/// The nearest whole number within a range, halves away from zero, as std::lround has it but
/// without a call.
/// @param value  not NaN
/// @param most   the range is -most .. most; 0 .. 2147483647
/// Real-time: yes.
[[nodiscard]] inline std::int32_t nearest_units(double value, double most) noexcept {
  const double held = std::max(std::min(value, most), -most);
  // What is added is the number before 1/2: with 1/2 itself the sum of the number before 1/2 would
  // round to 1.
  return static_cast<std::int32_t>(held + std::copysign(0x1.fffffffffffffp-2, held));
}

}  // namespace articula
