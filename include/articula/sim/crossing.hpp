// SPDX-License-Identifier: Apache-2.0
/// @file Location of a zero crossing.
#pragma once

#include <algorithm>
#include <cmath>

namespace articula {

/// An end of an interval in which a function crosses zero.
struct CrossingEnd {
  double argument;
  double value;  ///< of the function
};

/// The argument at which a function has just become positive, by interpolation, truncation and
/// projection (ITP). A straight line between the ends of the interval estimates the crossing.
/// Smooth functions take some ten calls, any other at most one call more than bisection. Source:
/// [Oliveira, Takahashi 2020, section 2.3], with k1 = 0.2 / (b - a), k2 = 2, n0 = 1. Beyond the
/// source, the last steps overshoot the estimate by half the width: the interval closes from both
/// ends.
/// @param before    end at which the function is not positive
/// @param after     end with the larger argument, at which it is positive
/// @param width     largest final interval
/// @param function  callable with an argument
/// @return          an argument at most `width` behind one at which the function is not positive;
///                  the function was called with it, or it is that of `after`
/// Real-time: yes if the function is.
template <class Function>
[[nodiscard]] double locate_crossing(CrossingEnd before, CrossingEnd after, double width,
                                     const Function& function) noexcept {
  const double truncation = 0.2 / (after.argument - before.argument);
  double reach = after.argument - before.argument;
  while (after.argument - before.argument > width) {
    const double length = after.argument - before.argument, middle = before.argument + length / 2;
    double guess = before.argument + length * (before.value / (before.value - after.value));
    const double to_middle = middle - guess;
    const double shift = std::max(truncation * length * length, width / 2);
    guess = shift <= std::abs(to_middle) ? guess + std::copysign(shift, to_middle) : middle;
    const double most = reach - length / 2;
    if (std::abs(guess - middle) > most) guess = middle - std::copysign(most, to_middle);
    if (!(guess > before.argument && guess < after.argument)) guess = middle;  // NaN, or rounding
    if (!(guess > before.argument && guess < after.argument)) break;  // no number in between
    const double value = function(guess);
    (value > 0 ? after : before) = {guess, value};
    reach /= 2;
  }
  return after.argument;
}

}  // namespace articula
