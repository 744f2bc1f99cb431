// SPDX-License-Identifier: Apache-2.0
/// @file Bounds of a sum of signals.
#pragma once

#include "articula/reference/signal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

namespace articula::detail {

/// The range of a sum of signals, 0 included.
struct SignalBounds {
  double low = 0;
  double high = 0;
};

/// The range of a sum of signals. Steps and ramps are added in the course of time, so that opposite
/// ones cancel. Waves are added as if their peaks coincided.
[[nodiscard]] inline SignalBounds bounds_of(const std::vector<Signal>& signals) {
  SignalBounds waves, lines;
  std::vector<double> corners;
  for (const Signal& signal : signals) {
    if (const auto* step = std::get_if<StepSignal>(&signal)) {
      corners.push_back(step->start);
    } else if (const auto* ramp = std::get_if<RampSignal>(&signal)) {
      corners.insert(corners.end(), {ramp->start, ramp->start + ramp->duration});
    } else if (const auto* chirp = std::get_if<ChirpSignal>(&signal)) {
      waves.high += std::abs(chirp->amplitude);
      waves.low -= std::abs(chirp->amplitude);
    } else if (const auto* sine = std::get_if<SineSignal>(&signal)) {
      waves.high += sine->offset + std::abs(sine->amplitude);
      waves.low += sine->offset - std::abs(sine->amplitude);
    } else if (const auto* square = std::get_if<SquareSignal>(&signal)) {
      waves.high += square->offset + std::abs(square->amplitude);
      waves.low += square->offset - std::abs(square->amplitude);
    }
  }
  for (const double corner : corners) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double time : {std::nextafter(corner, -infinity), corner}) {
      double sum = 0;
      for (const Signal& signal : signals) {
        if (const auto* step = std::get_if<StepSignal>(&signal)) sum += step->sample(time).value;
        if (const auto* ramp = std::get_if<RampSignal>(&signal)) sum += ramp->sample(time).value;
      }
      lines.high = std::max(lines.high, sum);
      lines.low = std::min(lines.low, sum);
    }
  }
  return {std::min(0.0, waves.low + lines.low), std::max(0.0, waves.high + lines.high)};
}

}  // namespace articula::detail
