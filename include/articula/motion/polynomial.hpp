// SPDX-License-Identifier: Apache-2.0
/// @file Polynomials of fixed degree: values, derivatives, roots and peaks.
#pragma once

#include "articula/core/finite.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace articula {

/// The value of the polynomial c_0 + c_1 x + c_2 x^2 + ...
/// @param c  coefficients, c_0 first
/// Real-time: yes.
template <std::size_t Count>
[[nodiscard]] double polynomial_value(const std::array<double, Count>& c, double x) noexcept {
  double value = c[Count - 1];
  for (std::size_t k = Count - 1; k-- > 0;) value = value * x + c[k];
  return value;
}

/// The coefficients of the derivative of a polynomial.
/// @param c  coefficients, c_0 first
/// Real-time: yes.
template <std::size_t Count>
[[nodiscard]] auto derivative_of(const std::array<double, Count>& c) noexcept {
  std::array<double, Count - 1> derivative;
  for (std::size_t k = 1; k < Count; ++k) derivative[k - 1] = static_cast<double>(k) * c[k];
  return derivative;
}

/// A list of numbers of limited length.
/// @tparam Capacity  largest number of values; what is added beyond it is ignored
template <std::size_t Capacity>
struct RootList {
  std::array<double, Capacity> values{};
  std::size_t size = 0;

  void add(double value) noexcept {
    if (size < Capacity) values[size++] = value;
  }
  [[nodiscard]] const double* begin() const noexcept { return values.data(); }
  [[nodiscard]] const double* end() const noexcept { return values.data() + size; }
};

namespace detail {

/// The root between two arguments with values of opposite sign, to rounding. It uses Newton's
/// method, and bisection where a Newton step would leave the bracket or would converge more slowly.
template <std::size_t Count>
[[nodiscard]] double root_between(const std::array<double, Count>& c, double low, double high,
                                  bool rises) noexcept {
  const auto slope = derivative_of(c);
  double x = low + (high - low) / 2, before = high - low;
  for (int k = 0; k < 200; ++k) {
    const double value = polynomial_value(c, x);
    ((value < 0) == rises ? low : high) = x;
    const double newton = x - value / polynomial_value(slope, x);
    const double next = newton > low && newton < high && std::abs(newton - x) < before / 2
                            ? newton
                            : low + (high - low) / 2;
    before = std::abs(next - x);
    if (next == x || value == 0) break;
    x = next;
  }
  return x;
}

}  // namespace detail

/// The roots of a polynomial within an interval, and its turning points there: rounding may have
/// removed a double root. They lie between the roots of the derivative, which are found likewise.
/// @param c          coefficients, c_0 first
/// @param low, high  the interval
/// @return           roots and turning points in ascending order
/// Real-time: yes. At most 200 evaluations for each.
template <std::size_t Count>
[[nodiscard]] RootList<Count*(Count - 1) / 2> roots_and_turns(const std::array<double, Count>& c,
                                                              double low, double high) noexcept {
  RootList<Count*(Count - 1) / 2> found;
  if constexpr (Count == 2) {
    const double x = -c[0] / c[1];
    if (x >= low && x <= high) found.add(x);
  } else {
    const auto turns = roots_and_turns(derivative_of(c), low, high);
    double from = low, value = polynomial_value(c, low);
    const auto search_until = [&](double to) {
      const double next = polynomial_value(c, to);
      if ((value < 0) != (next < 0)) found.add(detail::root_between(c, from, to, value < 0));
      from = to;
      value = next;
    };
    for (const double turn : turns) {
      search_until(turn);
      found.add(turn);
    }
    search_until(high);
  }
  return found;
}

/// The highest value of a polynomial on 0..1, or `known` where that is higher. A coefficient that
/// is not finite makes the result infinite.
/// @param c      coefficients, c_0 first
/// @param known  the limit of interest, or -infinity. A polynomial below it costs little time. One
///               above it by less than 1e-10 of it counts as below.
/// Real-time: yes.
template <std::size_t Count>
[[nodiscard]] double polynomial_peak(const std::array<double, Count>& c, double known) noexcept {
  // No value is above the highest coefficient in Bernstein form, b_i = sum over k of
  // binomial(i, k) / binomial(n, k) c_k, as Pascal's triangle. At 0 and 1 it is the first and last.
  std::array<double, Count> b = c;
  double binomial = 1;
  for (std::size_t k = 0; k < Count; ++k) {
    b[k] /= binomial;
    binomial = binomial * static_cast<double>(Count - 1 - k) / static_cast<double>(k + 1);
  }
  for (std::size_t pass = 1; pass < Count; ++pass) {
    for (std::size_t i = Count - 1; i >= pass; --i) b[i] += b[i - 1];
  }
  if (!std::ranges::all_of(b, [](double x) { return is_finite(x); })) {
    return std::numeric_limits<double>::infinity();
  }
  known = std::max({known, b.front(), b.back()});
  if (std::ranges::max(b) - known <= 1e-10 * std::abs(known)) return known;
  if constexpr (Count > 2) {
    for (const double x : roots_and_turns(derivative_of(c), 0, 1)) {
      known = std::max(known, polynomial_value(c, x));
    }
  }
  return known;
}

}  // namespace articula
