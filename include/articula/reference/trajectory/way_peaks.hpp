// SPDX-License-Identifier: Apache-2.0
/// @file How far the way between two points of a trajectory goes.
#pragma once

#include "articula/motion/polynomial_peak.hpp"
#include "articula/reference/trajectory/trajectory_point.hpp"

#include <algorithm>
#include <array>

namespace articula {

/// How far a way between two points goes.
/// @tparam N  number of joints
template <int N>
struct WayPeaks {
  JointVector<N> lowest, highest;         ///< position [rad or m], N x 1
  JointVector<N> velocity, acceleration;  ///< either way, N x 1
};

/// The peaks of the way between two points (way_between), found as polynomial_peak() does.
/// @param a, b   the points, b later than a
/// @param known  limits of interest, which the peaks are at least
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] WayPeaks<N> peaks_between(const TrajectoryPoint<N>& a, const TrajectoryPoint<N>& b,
                                        const WayPeaks<N>& known) noexcept {
  const auto way = way_between(a, b);
  const double T = b.time_from_start - a.time_from_start;
  WayPeaks<N> peaks;
  for (int j = 0; j < N; ++j) {
    const double c1 = way[0][j], c2 = way[1][j], c3 = way[2][j], c4 = way[3][j], c5 = way[4][j];
    const auto depth = [](auto c, double least) {  // how far it goes below 0
      for (double& x : c) x = -x;
      return polynomial_peak(c, least);
    };
    const auto size = [&](const auto& c, double least) {
      return std::max(polynomial_peak(c, least), depth(c, least));
    };
    const std::array<double, 6> q{a.position[j], c1, c2, c3, c4, c5};
    const std::array<double, 5> v{c1 / T, 2 * c2 / T, 3 * c3 / T, 4 * c4 / T, 5 * c5 / T};
    const std::array<double, 4> acceleration{2 * c2 / T / T, 6 * c3 / T / T, 12 * c4 / T / T,
                                             20 * c5 / T / T};
    peaks.lowest[j] = -depth(q, -known.lowest[j]);
    peaks.highest[j] = polynomial_peak(q, known.highest[j]);
    peaks.velocity[j] = size(v, known.velocity[j]);
    peaks.acceleration[j] = size(acceleration, known.acceleration[j]);
  }
  return peaks;
}

}  // namespace articula
