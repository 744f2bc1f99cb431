// SPDX-License-Identifier: Apache-2.0
/// @file Polynomials and their positive roots, for frequency responses.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace articula::detail {

/// c0 + c1 x + c2 x^2 + ...
struct Polynomial {
  std::vector<double> coefficients;  ///< the lowest first

  [[nodiscard]] double operator()(double x) const {
    double value = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) value = value * x + coefficients[i];
    return value;
  }

  [[nodiscard]] Polynomial derivative() const {
    Polynomial slope;
    for (std::size_t i = 1; i < coefficients.size(); ++i) {
      slope.coefficients.push_back(static_cast<double>(i) * coefficients[i]);
    }
    return slope;
  }

  [[nodiscard]] friend Polynomial operator*(const Polynomial& p, const Polynomial& q) {
    const auto &a = p.coefficients, &b = q.coefficients;
    Polynomial product{std::vector<double>(a.size() + b.size() - 1)};
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) product.coefficients[i + j] += a[i] * b[j];
    }
    return product;
  }

  [[nodiscard]] friend Polynomial operator-(const Polynomial& p, const Polynomial& q) {
    Polynomial difference = p;
    auto& c = difference.coefficients;
    c.resize(std::max(c.size(), q.coefficients.size()));
    for (std::size_t i = 0; i < q.coefficients.size(); ++i) c[i] -= q.coefficients[i];
    return difference;
  }
};

/// @throws std::invalid_argument unless x is finite
inline void require_moderate(const double& x) {
  if (!is_finite(x))
    refuse({"the gains, plant or delay of the control loop are too large or too small"});
}

/// The point between two others at which a predicate changes, to the last bit.
/// @param is_first  whether x is on the side of `low`
template <class IsFirst>
[[nodiscard]] double bisect(double low, double high, const IsFirst& is_first) {
  while (true) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return high;
    (is_first(middle) ? low : high) = middle;
  }
}

/// The positive numbers at which a polynomial changes its sign, in ascending order. Between two
/// such numbers of its derivative it is monotone, so bisection finds the one that may be there.
/// @throws std::invalid_argument if a coefficient or a root has overflowed
[[nodiscard]] inline std::vector<double> positive_roots(Polynomial p) {
  std::vector<double>& c = p.coefficients;
  for (const double& k : c) require_moderate(k);
  while (!c.empty() && c.back() == 0) c.pop_back();
  c.erase(c.begin(), std::find_if(c.begin(), c.end(), [](double k) { return k != 0; }));
  if (c.size() < 2) return {};

  const auto is_positive = [&](double x) { return p(x) > 0; };
  std::vector<double> roots;
  double low = 0;
  const auto search_until = [&](double high) {
    const bool before = is_positive(low);
    if (before != is_positive(high)) {
      roots.push_back(bisect(low, high, [&](double x) { return is_positive(x) == before; }));
    }
    low = high;
  };
  for (const double turn : positive_roots(p.derivative())) search_until(turn);
  double high = std::max(1.0, 2 * low);
  while (is_positive(high) != (c.back() > 0)) require_moderate(high *= 2);
  search_until(high);
  return roots;
}

}  // namespace articula::detail
