// SPDX-License-Identifier: Apache-2.0
/// @file Derivatives by differences.
#pragma once

namespace support {

/// df/dt at t = 0 by central differences of fourth order: off by h^4/30 of the fifth derivative,
/// and by rounding, 1.5e-16/h of the size of f. With h = 1e-3 both are about 1e-12 where f changes
/// on the scale of 1.
/// @param f  makes a number, or an Eigen vector or matrix by value, of a number
template <class Function>
[[nodiscard]] auto slope(const Function& f) {
  const double h = 1e-3;
  using Value = decltype(f(h));
  const Value near = f(h) - f(-h), far = f(2 * h) - f(-2 * h);
  return Value((8 * near - far) / (12 * h));
}

}  // namespace support
