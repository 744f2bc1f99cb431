// SPDX-License-Identifier: Apache-2.0
/// @file The points of a trajectory and what lies between two of them.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_vector.hpp"

#include <array>
#include <optional>

namespace articula {

/// Where N joints shall be at a time.
/// @tparam N  number of joints
template <int N>
struct TrajectoryPoint {
  double time_from_start = 0;                        ///< [s]
  JointVector<N> position = JointVector<N>::Zero();  ///< [rad or m], N x 1
  std::optional<JointVector<N>> velocity{};          ///< [rad/s or m/s], N x 1; may be left open
  std::optional<JointVector<N>> acceleration{};    ///< [rad/s^2 or m/s^2], N x 1; may be left open
  JointVector<N> effort = JointVector<N>::Zero();  ///< feed-forward [N m or N], N x 1
};

/// The reference that a point is, with 0 for what it leaves open.
/// Real-time: yes.
template <int N>
[[nodiscard]] JointReference<N> at_point(const TrajectoryPoint<N>& point) noexcept {
  const JointVector<N> zero = JointVector<N>::Zero();
  return {point.position, point.velocity ? *point.velocity : zero,
          point.acceleration ? *point.acceleration : zero, point.effort};
}

/// The way between two points a and b as a polynomial in s = t / T, with t since a and T from a to
/// b: q = q_a + s (c_1 + s (c_2 + s (c_3 + s (c_4 + s c_5)))). What both points have decides on the
/// degree, as in ROS's joint trajectory controller:
///
/// - position alone: the straight line,
/// - velocity too: the cubic with these velocities at the ends,
/// - velocity and acceleration too: the quintic,
/// - acceleration without velocity: the cubic with these accelerations at the ends
///   (the controller has no rule for it and gives zero).
///
/// @param a, b  the points, b later than a
/// @return      c_1 to c_5 [rad or m], N x 1 each
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] std::array<JointVector<N>, 5> way_between(const TrajectoryPoint<N>& a,
                                                        const TrajectoryPoint<N>& b) noexcept {
  using Vector = JointVector<N>;
  const double T = b.time_from_start - a.time_from_start;
  const Vector d = b.position - a.position, zero = Vector::Zero();
  const bool velocities = a.velocity && b.velocity,
             accelerations = a.acceleration && b.acceleration;
  // Velocities and accelerations per T and T^2, so that no power of T is divided by.
  const Vector va = velocities ? Vector(T * *a.velocity) : zero;
  const Vector vb = velocities ? Vector(T * *b.velocity) : zero;
  const Vector aa = accelerations ? Vector(T * T * *a.acceleration) : zero;
  const Vector ab = accelerations ? Vector(T * T * *b.acceleration) : zero;
  Vector c1 = d, c2 = aa / 2, c3 = zero, c4 = zero, c5 = zero;
  if (velocities && accelerations) {
    c1 = va;
    c3 = 10 * d - 6 * va - 4 * vb - 1.5 * aa + 0.5 * ab;
    c4 = -15 * d + 8 * va + 7 * vb + 1.5 * aa - ab;
    c5 = 6 * d - 3 * (va + vb) - (aa - ab) / 2;
  } else if (velocities) {
    c1 = va;
    c2 = 3 * d - 2 * va - vb;
    c3 = va + vb - 2 * d;
  } else if (accelerations) {
    c1 = d - (2 * aa + ab) / 6;
    c3 = (ab - aa) / 6;
  }
  return {c1, c2, c3, c4, c5};
}

/// The reference between two points, at a time since the first one: on the way_between() them, with
/// an effort that is linear.
/// @param a, b  the points, b later than a
/// @param t     0 <= t <= T [s]
/// Real-time: yes. O(N).
template <int N>
[[nodiscard]] JointReference<N> interpolate(const TrajectoryPoint<N>& a,
                                            const TrajectoryPoint<N>& b, double t) noexcept {
  const double T = b.time_from_start - a.time_from_start, s = t / T;
  const auto [c1, c2, c3, c4, c5] = way_between(a, b);
  JointReference<N> r;
  r.position = a.position + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))));
  r.velocity = (c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / T;
  r.acceleration = (2 * c2 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / T / T;
  r.effort = a.effort + (b.effort - a.effort) * s;
  return r;
}

}  // namespace articula
