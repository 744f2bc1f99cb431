// SPDX-License-Identifier: Apache-2.0
/// @file Velocities of points that have only positions.
#pragma once

#include "articula/reference/trajectory/trajectory_point.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace articula {

/// Gives each point without a velocity the one that the cubic spline through all points has there.
/// The spline has continuous accelerations [Biagiotti, Melchiorri 2008, section 4.4]: with
/// h_k = t_(k+1) - t_k the velocities solve
///
///     v_(k-1)/h_(k-1) + 2 (1/h_(k-1) + 1/h_k) v_k + v_(k+1)/h_k
///         = 3 ((q_k - q_(k-1))/h_(k-1)^2 + (q_(k+1) - q_k)/h_k^2),
///
/// a tridiagonal system, which Thomas's algorithm solves. Velocities that points already have stay.
/// The last velocity is 0. So is that of a first point at time 0, where a motion begins at rest. At
/// a first point later than 0, the acceleration is 0 (natural spline).
/// @param points  times strictly increasing; points without a velocity receive one
/// Real-time: no (allocates).
template <int N>
void set_spline_velocities(std::span<TrajectoryPoint<N>> points) {
  using Vector = JointVector<N>;
  if (points.empty()) return;
  const auto width = [&](std::size_t k) {
    return points[k + 1].time_from_start - points[k].time_from_start;
  };
  const auto slope = [&](std::size_t k, int j) {
    return (points[k + 1].position[j] - points[k].position[j]) / width(k);
  };
  // After elimination, v_k = rest_k - factor_k v_(k+1).
  std::vector<double> factor(points.size());
  std::vector<Vector> rest(points.size());
  const std::size_t last = points.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const bool rests = k == last || (k == 0 && points[0].time_from_start == 0);
    if (points[k].velocity || rests) {
      factor[k] = 0;
      rest[k] = points[k].velocity.value_or(Vector::Zero());
    } else if (k == 0) {
      factor[0] = 0.5;
      rest[0] = for_each_joint<N>([&](int j) noexcept { return 1.5 * slope(0, j); });
    } else {
      const double before = 1 / width(k - 1), after = 1 / width(k);
      const double pivot = 2 * (before + after) - before * factor[k - 1];
      factor[k] = after / pivot;
      rest[k] = for_each_joint<N>([&](int j) noexcept {
        const double slopes = before * slope(k - 1, j) + after * slope(k, j);
        return (3 * slopes - before * rest[k - 1][j]) / pivot;
      });
    }
  }
  Vector next = Vector::Zero();
  for (std::size_t k = last + 1; k-- > 0;) {
    for (int j = 0; j < N; ++j) next[j] = rest[k][j] - factor[k] * next[j];
    if (!points[k].velocity) points[k].velocity = next;
  }
}

}  // namespace articula
