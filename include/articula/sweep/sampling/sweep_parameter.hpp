// SPDX-License-Identifier: Apache-2.0
/// @file A number that varies from run to run, and its range.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace articula {

/// How the values of a parameter are spaced in its range.
enum class Spacing : unsigned char {
  linear,       ///< equal differences; all values are equally probable
  logarithmic,  ///< equal ratios; all orders of magnitude are equally probable
};

/// A number that varies from run to run.
struct SweepParameter {
  std::string name{};
  std::string unit{};  ///< "1" if it has none
  double low = 0;      ///< lowest value [unit]
  double high = 0;     ///< highest value [unit]
  Spacing spacing = Spacing::linear;
  int levels = 11;  ///< number of values in a grid, the ends included; 1: the middle

  /// The value at a share of the range.
  /// @param share  0 .. 1
  /// Real-time: yes.
  [[nodiscard]] double value(double share) const noexcept {
    if (spacing == Spacing::linear) return std::clamp(std::lerp(low, high, share), low, high);
    return std::clamp(std::exp(std::lerp(std::log(low), std::log(high), share)), low, high);
  }

  /// The share of the range that has a value; 0 in a range without width.
  /// @param x  within low .. high
  /// Real-time: yes.
  [[nodiscard]] double share(double x) const noexcept {
    if (low == high) return 0;
    const double share = spacing == Spacing::linear ? (x - low) / (high - low)
                                                    : std::log(x / low) / std::log(high / low);
    return std::clamp(share, 0.0, 1.0);
  }
};

/// Refuses a parameter without a range.
/// @throws std::invalid_argument naming the parameter, the value and what is accepted
/// Real-time: no (throws).
inline void validate(const SweepParameter& parameter) {
  const auto refuse = [&](detail::MessageParts parts) {
    detail::refuse({"sweep: parameter '", parameter.name, "': ", detail::message_of(parts)});
  };
  if (parameter.name.empty()) detail::refuse({"sweep: a parameter has no name"});
  if (!is_finite(parameter.low) || !is_finite(parameter.high)) {
    refuse({"its range ", parameter.low, " .. ", parameter.high, " is not finite"});
  }
  if (!(parameter.low <= parameter.high)) {
    refuse({"its low end ", parameter.low, " is above its high end ", parameter.high});
  }
  if (!is_finite(parameter.high - parameter.low)) refuse({"its range overflows"});
  if (parameter.spacing == Spacing::logarithmic && !(parameter.low > 0)) {
    refuse({"its low end ", parameter.low, " is not above 0, as a logarithmic range needs"});
  }
  constexpr int most_levels = 1'000'000;
  if (parameter.levels < 1 || parameter.levels > most_levels) {
    refuse({"its levels ", parameter.levels, " are not within 1 .. ", most_levels});
  }
}

}  // namespace articula
