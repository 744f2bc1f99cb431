// SPDX-License-Identifier: Apache-2.0
/// @file Bounds of a sum of signals.
#pragma once

#include "articula/motion/joint_motion.hpp"
#include "articula/reference/signal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <variant>
#include <vector>

namespace articula {

/// The range of a sum of signals, 0 included. Steps and ramps are added in the course of time, so
/// that opposite ones cancel. Waves are added as if their peaks coincided.
/// Real-time: no (allocates).
[[nodiscard]] inline ValueRange signal_bounds(std::span<const Signal> signals) {
  ValueRange waves, lines;
  std::vector<double> corners;
  for (const Signal& signal : signals) {
    std::visit(
        [&](const auto& any) {
          if constexpr (requires { any.height; }) {
            corners.push_back(any.start);
            if constexpr (requires { any.duration; }) corners.push_back(any.start + any.duration);
          } else {
            double offset = 0;
            if constexpr (requires { any.offset; }) offset = any.offset;
            waves.highest += offset + std::abs(any.amplitude);
            waves.lowest += offset - std::abs(any.amplitude);
          }
        },
        signal);
  }
  for (const double corner : corners) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double time : {std::nextafter(corner, -infinity), corner}) {
      double sum = 0;
      for (const Signal& signal : signals) {
        std::visit(
            [&](const auto& any) {
              if constexpr (requires { any.height; }) sum += any.sample(time).value;
            },
            signal);
      }
      lines.highest = std::max(lines.highest, sum);
      lines.lowest = std::min(lines.lowest, sum);
    }
  }
  return {std::min(0.0, waves.lowest + lines.lowest), std::max(0.0, waves.highest + lines.highest)};
}

}  // namespace articula
