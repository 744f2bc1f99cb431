// SPDX-License-Identifier: Apache-2.0
/// @file Where a function passes zero.
#pragma once

#include <algorithm>
#include <cmath>

namespace articula {

/// An end of an interval in which a function passes zero, and the function's value there.
struct CrossingEnd {
  double place;
  double value;
};

/// The place where a function has just become positive, found by interpolation, truncation and
/// projection: between the ends of the interval a straight line tells where zero is likely to be,
/// and no step leaves more of the interval than one that halves it, but for a single step in all.
/// Smooth functions take some ten calls, any other one more than halving.
/// Source: [Oliveira, Takahashi 2020, section 2.3], with k1 = 0.2 / (b - a), k2 = 2, n0 = 1;
/// the last steps go beyond the line's guess by half the width, so that the interval closes from
/// both ends.
/// @param before    where the function is not positive
/// @param after     further on, where it is positive
/// @param width     how closely it is to be found
/// @param function  callable with a place
/// @return          a place at most `width` behind one where the function is not positive; the
///                  function was called there, or it is that of `after`
/// Real-time: yes if the function is.
template <class Function>
[[nodiscard]] double locate_crossing(CrossingEnd before, CrossingEnd after, double width,
                                     const Function& function) noexcept {
  const double truncation = 0.2 / (after.place - before.place);
  double reach = after.place - before.place;
  while (after.place - before.place > width) {
    const double length = after.place - before.place, middle = before.place + length / 2;
    double guess = before.place + length * (before.value / (before.value - after.value));
    const double to_middle = middle - guess;
    const double shift = std::max(truncation * length * length, width / 2);
    guess = shift <= std::abs(to_middle) ? guess + std::copysign(shift, to_middle) : middle;
    const double most = reach - length / 2;
    if (std::abs(guess - middle) > most) guess = middle - std::copysign(most, to_middle);
    if (!(guess > before.place && guess < after.place))
      guess = middle;                                           // no number, or rounded off
    if (!(guess > before.place && guess < after.place)) break;  // there is no place in between
    const double value = function(guess);
    (value > 0 ? after : before) = {guess, value};
    reach /= 2;
  }
  return after.place;
}

}  // namespace articula
