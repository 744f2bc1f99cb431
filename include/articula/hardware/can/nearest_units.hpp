// SPDX-License-Identifier: Apache-2.0
/// @file Rounding to the integer units of a frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace articula {

/// The nearest integer within a range. Halves are rounded away from zero as by std::lround, but
/// without a library call.
/// @param value  not NaN
/// @param most   the range is -most .. most; 0 .. 2147483647
/// Real-time: yes.
[[nodiscard]] inline std::int32_t nearest_units(double value, double most) noexcept {
  const double held = std::max(std::min(value, most), -most);
  // The summand is the largest number below 1/2. With 1/2 itself, that number would round to 1.
  return static_cast<std::int32_t>(held + std::copysign(0x1.fffffffffffffp-2, held));
}

}  // namespace articula
