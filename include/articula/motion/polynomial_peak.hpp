// SPDX-License-Identifier: Apache-2.0
/// @file How high a polynomial rises.
#pragma once

#include "articula/core/finite.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace articula {

namespace detail {

/// The highest value on 0..1 of a polynomial in Bernstein form, or `known` where that is higher.
/// The polynomial never rises above the highest of its coefficients, and takes the first and the
/// last at the ends; halved (de Casteljau), it lies four times closer to them.
template <std::size_t Count>
[[nodiscard]] double bernstein_peak(std::array<double, Count> right, double known,
                                    int halvings) noexcept {
  double bound = right[0];
  for (const double x : right) {
    if (!is_finite(x)) return std::numeric_limits<double>::infinity();
    bound = std::max(bound, x);
  }
  known = std::max({known, right.front(), right.back()});
  if (bound - known <= 1e-10 * std::abs(known)) return known;
  if (halvings == 0) return bound;
  std::array<double, Count> left{};
  for (std::size_t i = 0; i < Count; ++i) {
    left[i] = right[0];
    for (std::size_t k = 0; k + i + 1 < Count; ++k) right[k] += (right[k + 1] - right[k]) / 2;
  }
  known = bernstein_peak(left, known, halvings - 1);
  return bernstein_peak(right, known, halvings - 1);
}

}  // namespace detail

/// The highest value on 0..1 of the polynomial c_0 + c_1 s + c_2 s^2 + ..., or a value that is
/// known where that is higher. What is returned is off by 1e-10 of itself and of what the
/// coefficients are apart. A coefficient that is not finite makes it infinite.
/// @param coefficients  c_0, c_1, ...
/// @param known         -infinity, or the limit that is of interest: where the polynomial is far
///                      below, little is computed
/// Real-time: yes.
template <std::size_t Count>
[[nodiscard]] double polynomial_peak(std::array<double, Count> coefficients,
                                     double known) noexcept {
  static_assert(Count >= 2 && Count <= 6, "of degree one to five");
  // b_i = sum over k of binomial(i, k) / binomial(n, k) c_k: scaled, then summed up as in Pascal's
  // triangle.
  double binomial = 1;
  for (std::size_t k = 0; k < Count; ++k) {
    coefficients[k] /= binomial;
    binomial = binomial * static_cast<double>(Count - 1 - k) / static_cast<double>(k + 1);
  }
  for (std::size_t pass = 1; pass < Count; ++pass) {
    for (std::size_t i = Count - 1; i >= pass; --i) coefficients[i] += coefficients[i - 1];
  }
  constexpr int halvings = 16;
  return detail::bernstein_peak(coefficients, known, halvings);
}

}  // namespace articula
