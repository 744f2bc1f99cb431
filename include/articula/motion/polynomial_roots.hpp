// SPDX-License-Identifier: Apache-2.0
/// @file Where a polynomial is zero.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace articula {

/// Numbers in increasing order, as many as there are.
/// @tparam Capacity  most numbers
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

template <std::size_t Count>
[[nodiscard]] double polynomial_value(const std::array<double, Count>& c, double x) noexcept {
  double value = c[Count - 1];
  for (std::size_t k = Count - 1; k-- > 0;) value = value * x + c[k];
  return value;
}

template <std::size_t Count>
[[nodiscard]] auto derivative_of(const std::array<double, Count>& c) noexcept {
  std::array<double, Count - 1> derivative{};
  for (std::size_t k = 1; k < Count; ++k) derivative[k - 1] = static_cast<double>(k) * c[k];
  return derivative;
}

/// The zero between two values of opposite sign, to rounding: Newton's method, and bisection
/// wherever that would leave the bracket or halves it too slowly.
template <std::size_t Count>
[[nodiscard]] double zero_between(const std::array<double, Count>& c, double low, double high,
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

/// The zeros of c_0 + c_1 x + ... + c_n x^n within an interval, and the points at which the
/// polynomial turns around there: a double zero may have become none by rounding. They are found
/// between the zeros of the derivative, which are found likewise.
/// @param c          coefficients, c_0 first
/// @param low, high  the interval
/// Real-time: yes. At most 200 evaluations for each.
template <std::size_t Count>
[[nodiscard]] RootList<Count*(Count - 1) / 2> roots_and_turns(const std::array<double, Count>& c,
                                                              double low, double high) noexcept {
  RootList<Count*(Count - 1) / 2> found;
  if constexpr (Count == 2) {
    const double x = -c[0] / c[1];
    if (x >= low && x <= high) found.add(x);
  } else {
    const auto turns = roots_and_turns(detail::derivative_of(c), low, high);
    double from = low, value = detail::polynomial_value(c, low);
    const auto go_to = [&](double to) {
      const double next = detail::polynomial_value(c, to);
      if ((value < 0) != (next < 0)) found.add(detail::zero_between(c, from, to, value < 0));
      from = to;
      value = next;
    };
    for (const double turn : turns) {
      go_to(turn);
      found.add(turn);
    }
    go_to(high);
  }
  return found;
}

}  // namespace articula
