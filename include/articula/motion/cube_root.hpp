// SPDX-License-Identifier: Apache-2.0
/// @file The cube root.
#pragma once

#include <cmath>

namespace articula {

/// The cube root of x >= 0, within two units in the last place. Unlike std::cbrt it has the same
/// bits with every C library. It runs five steps of Newton's iteration y <- y - (y - z/y^2)/3 on a
/// z from 1/2 to 4. They start from a line that is at most 9 % off.
/// @param x  any; infinity and NaN are their own
/// Real-time: yes.
[[nodiscard]] inline double cube_root(double x) noexcept {
  if (!(x > 0) || std::isinf(x)) return x;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // from 1/2 to 1
  const int rest = (exponent % 3 + 3) % 3;
  const double z = std::ldexp(mantissa, rest);
  double y = 0.75 + 0.22 * z;
  for (int k = 0; k < 5; ++k) y -= (y - z / (y * y)) / 3;
  return std::ldexp(y, (exponent - rest) / 3);
}

}  // namespace articula
