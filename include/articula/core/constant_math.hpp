// SPDX-License-Identifier: Apache-2.0
/// @file Square root, sine and cosine of constants, at compile time.
///
/// The functions of <cmath> are not constexpr in C++20, but a robot's description contains angles
/// of frames. Use these functions for constants only: at run time <cmath> is faster.
#pragma once

#include "articula/core/finite.hpp"

#include <limits>

namespace articula::constant_math {

/// The square root of a >= 0, within one unit in the last place. NaN for a < 0.
/// Newton's iteration x <- (x + a/x)/2 in extended precision, from above, until x no longer falls.
/// Real-time: yes, though meant for compile time.
[[nodiscard]] constexpr double square_root(double a) noexcept {
  if (!is_finite(a) || a < 0) return a > 0 ? a : std::numeric_limits<double>::quiet_NaN();
  if (a == 0) return a;
  const auto wide = static_cast<long double>(a);
  long double x = a > 1 ? wide : 1.0L;
  for (;;) {
    const long double next = (x + wide / x) / 2;
    if (!(next < x)) return static_cast<double>(x);
    x = next;
  }
}

/// Sine and cosine of one angle.
struct SineCosine {
  double sine;    ///< dimensionless
  double cosine;  ///< dimensionless
};

/// The largest angle of sine_cosine [rad].
inline constexpr double largest_angle = 1e9;

/// Sine and cosine of an angle [rad], within one unit in the last place for |angle| <= 1e4, NaN for
/// |angle| > largest_angle. The angle is reduced to [-pi/4, pi/4] with pi/2 in three parts. The
/// first two have so few bits that their products with the number of right angles are exact [Cody,
/// Waite 1980, chapter 8]. Then 21 terms of the Taylor series are summed in extended precision.
/// Real-time: yes, though meant for compile time.
[[nodiscard]] constexpr SineCosine sine_cosine(double angle) noexcept {
  constexpr long double head = 0x1.921fb544p0L, middle = 0x1.0b4611a6p-34L,
                        tail = 0x1.3198a2e03707344ap-69L;
  if (!(angle >= -largest_angle && angle <= largest_angle)) {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  const auto wide = static_cast<long double>(angle);
  const auto quarter = static_cast<long long>(wide / head + (angle < 0 ? -0.5L : 0.5L));
  const auto turns = static_cast<long double>(quarter);
  const long double x = ((wide - turns * head) - turns * middle) - turns * tail;
  long double sine = 0, cosine = 0, term = 1;
  for (int k = 0; k < 21; ++k) {
    (k % 2 == 0 ? cosine : sine) += (k / 2) % 2 == 0 ? term : -term;
    term *= x / static_cast<long double>(k + 1);
  }
  const auto s = static_cast<double>(sine), c = static_cast<double>(cosine);
  switch (((quarter % 4) + 4) % 4) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace articula::constant_math
