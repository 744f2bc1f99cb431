// SPDX-License-Identifier: Apache-2.0
/// @file The extreme positions, velocities and accelerations between two points of a trajectory.
#pragma once

#include "articula/motion/polynomial.hpp"
#include "articula/reference/trajectory/trajectory_point.hpp"

#include <algorithm>
#include <array>

namespace articula {

/// The extremes of a segment.
/// @tparam N  number of joints
template <int N>
struct SegmentPeaks {
  JointVector<N> lowest, highest;         ///< position [rad or m], N x 1
  JointVector<N> velocity, acceleration;  ///< largest absolute value, N x 1
};

/// The extremes of the segment between two points (segment_polynomial), by polynomial_peak().
/// @param a, b   the points, b later than a
/// @param known  limits of interest: extremes within them are replaced by the limits
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] SegmentPeaks<N> segment_peaks(const TrajectoryPoint<N>& a,
                                            const TrajectoryPoint<N>& b,
                                            const SegmentPeaks<N>& known) noexcept {
  const auto polynomial = segment_polynomial(a, b);
  const double T = b.time_from_start - a.time_from_start;
  const auto rate_of = [T](auto coefficients) {
    auto rate = derivative_of(coefficients);
    for (double& c : rate) c /= T;
    return rate;
  };
  const auto depth = [](auto c, double least) {  // how far a polynomial goes below 0
    for (double& x : c) x = -x;
    return polynomial_peak(c, least);
  };
  const auto size = [&](const auto& c, double least) {
    return std::max(polynomial_peak(c, least), depth(c, least));
  };
  SegmentPeaks<N> peaks;
  for (int j = 0; j < N; ++j) {
    std::array<double, 6> q;
    for (std::size_t k = 0; k < q.size(); ++k) q[k] = polynomial[k][j];
    const auto v = rate_of(q);
    peaks.lowest[j] = -depth(q, -known.lowest[j]);
    peaks.highest[j] = polynomial_peak(q, known.highest[j]);
    peaks.velocity[j] = size(v, known.velocity[j]);
    peaks.acceleration[j] = size(rate_of(v), known.acceleration[j]);
  }
  return peaks;
}

}  // namespace articula
