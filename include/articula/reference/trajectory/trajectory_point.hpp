// SPDX-License-Identifier: Apache-2.0
/// @file The points of a trajectory, and the segment between two of them with its extremes.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/motion/joint_motion.hpp"
#include "articula/motion/polynomial.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace articula {

/// The position of N joints at a time, and optionally their velocity and acceleration.
template <int N>
struct TrajectoryPoint {
  double time_from_start = 0;                        ///< [s]
  JointVector<N> position = JointVector<N>::Zero();  ///< [rad or m], N x 1
  std::optional<JointVector<N>> velocity{};          ///< [rad/s or m/s], N x 1
  std::optional<JointVector<N>> acceleration{};      ///< [rad/s^2 or m/s^2], N x 1
  JointVector<N> effort = JointVector<N>::Zero();    ///< feed-forward [N m or N], N x 1
};

/// The segments of a trajectory.
enum class Interpolation : unsigned char {
  splines,  ///< polynomials, see segment_polynomial()
  none,     ///< steps: from each point on, the reference is the next point
};

/// The reference at a point, with 0 for what the point leaves out. Real-time: yes.
template <int N>
[[nodiscard]] JointReference<N> at_point(const TrajectoryPoint<N>& point) noexcept {
  const JointVector<N> zero = JointVector<N>::Zero();
  // value_or() makes g++ 12 warn of values that may be uninitialised.
  return {point.position, point.velocity ? *point.velocity : zero,
          point.acceleration ? *point.acceleration : zero, point.effort};
}

/// The index of the first point after a time [s]; the number of points if there is none.
/// Real-time: yes. O(log of the number of points).
template <int N>
[[nodiscard]] std::size_t next_point(std::span<const TrajectoryPoint<N>> points,
                                     double time) noexcept {
  const auto later = [](double t, const auto& point) { return t < point.time_from_start; };
  return static_cast<std::size_t>(std::upper_bound(points.begin(), points.end(), time, later) -
                                  points.begin());
}

namespace detail {

/// The polynomial of one joint, see segment_polynomial(). Vectors of N joints take longer to
/// compile.
/// @param a, b           the points, with velocities times T and accelerations times T^2
/// @param velocities     whether both points have them
/// @param accelerations  likewise
[[nodiscard]] inline std::array<double, 6> segment_of_joint(const JointMotion& a,
                                                            const JointMotion& b, bool velocities,
                                                            bool accelerations) noexcept {
  const double d = b.position - a.position, va = a.velocity, vb = b.velocity;
  const double aa = a.acceleration, ab = b.acceleration;
  if (velocities && accelerations) {
    return {a.position,
            va,
            aa / 2,
            10 * d - 6 * va - 4 * vb - 1.5 * aa + 0.5 * ab,
            -15 * d + 8 * va + 7 * vb + 1.5 * aa - ab,
            6 * d - 3 * (va + vb) - (aa - ab) / 2};
  }
  if (velocities) return {a.position, va, 3 * d - 2 * va - vb, va + vb - 2 * d, 0, 0};
  if (accelerations) return {a.position, d - (2 * aa + ab) / 6, aa / 2, (ab - aa) / 6, 0, 0};
  return {a.position, d, 0, 0, 0, 0};
}

}  // namespace detail

/// The position between two points a and b as a polynomial in s = t / T. Here t is the time since
/// a, and T the duration. The values that both points have determine the degree, as in ROS's joint
/// trajectory controller:
///
/// - position alone: the straight line,
/// - velocity too: the cubic with these velocities at the ends,
/// - velocity and acceleration too: the quintic,
/// - acceleration without velocity: the cubic with these accelerations at the ends
///   (the controller has no rule for this case and gives zero).
///
/// @param a, b  the points, b later than a
/// @return      coefficients c_0 to c_5 [rad or m], N x 1 each
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] std::array<JointVector<N>, 6> segment_polynomial(
    const TrajectoryPoint<N>& a, const TrajectoryPoint<N>& b) noexcept {
  const double T = b.time_from_start - a.time_from_start;
  const bool velocities = a.velocity && b.velocity,
             accelerations = a.acceleration && b.acceleration;
  std::array<JointVector<N>, 6> polynomial;
  for (int j = 0; j < N; ++j) {
    // Velocities times T and accelerations times T^2, so that no power of T is a divisor.
    const auto scaled = [&](const TrajectoryPoint<N>& point) {
      return JointMotion{point.position[j], velocities ? T * (*point.velocity)[j] : 0,
                         accelerations ? T * T * (*point.acceleration)[j] : 0};
    };
    const std::array<double, 6> own =
        detail::segment_of_joint(scaled(a), scaled(b), velocities, accelerations);
    for (std::size_t k = 0; k < own.size(); ++k) polynomial[k][j] = own[k];
  }
  return polynomial;
}

/// The reference between two points: the segment_polynomial() and its derivatives, with linear
/// effort.
/// @param a, b  the points, b later than a
/// @param t     time since a, 0 <= t <= T [s]
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] JointReference<N> interpolate(const TrajectoryPoint<N>& a,
                                            const TrajectoryPoint<N>& b, double t) noexcept {
  const double T = b.time_from_start - a.time_from_start, s = t / T;
  const auto polynomial = segment_polynomial(a, b);
  JointReference<N> reference;
  for (int j = 0; j < N; ++j) {
    const double c0 = polynomial[0][j], c1 = polynomial[1][j], c2 = polynomial[2][j],
                 c3 = polynomial[3][j], c4 = polynomial[4][j], c5 = polynomial[5][j];
    reference.position[j] = c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))));
    reference.velocity[j] = (c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / T;
    reference.acceleration[j] = (2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / T / T;
    reference.effort[j] = a.effort[j] + (b.effort[j] - a.effort[j]) * s;
  }
  return reference;
}

/// The reference between two points for either kind of segment.
/// @param a, b  the points, b later than a
/// @param time  on the clock of the points [s]
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] JointReference<N> interpolate(Interpolation interpolation,
                                            const TrajectoryPoint<N>& a,
                                            const TrajectoryPoint<N>& b, double time) noexcept {
  if (interpolation == Interpolation::none) return at_point(b);
  return interpolate(a, b, time - a.time_from_start);
}

/// The extremes of a segment.
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
