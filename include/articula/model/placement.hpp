// SPDX-License-Identifier: Apache-2.0
/// @file Where a frame stands in another.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/model/vector3.hpp"

namespace articula {

/// Where frame B stands in frame A: x_A = rotation x_B + translation.
template <class S>
struct Placement {
  Matrix3<S> rotation = Matrix3<S>::identity();  ///< R_AB, 3 x 3, orthonormal
  Vector3<S> translation{};                      ///< origin of B in A [m], 3 x 1

  /// Chains two placements: X_AC = X_AB X_BC.
  friend constexpr Placement operator*(const Placement& ab, const Placement& bc) {
    return {ab.rotation * bc.rotation, ab.rotation * bc.translation + ab.translation};
  }
};

/// The rotation of fixed-axis roll, pitch, yaw angles, as URDF defines them: R = Rz(yaw) Ry(pitch)
/// Rx(roll). Sines and cosines within 1e-15 of 0, 1 and -1 are taken as such, so that a right angle
/// written as the double nearest to pi/2 gives exact zeros and ones.
/// @param rpy  roll, pitch, yaw [rad], 3 x 1; by value, because g++ 12 mistakes a reference to a
///             part of a constant that a function has filled member by member
[[nodiscard]] constexpr Matrix3<double> rotation_from_rpy(Vector3<double> rpy) noexcept {
  const auto sine_cosine = [](double angle) {
    auto [s, c] = constant_math::sine_cosine(angle);
    constexpr double rounding =
        1e-15;  // a sine near 0 is off by the rounding of the angle, half of 2^-52 pi
    if (s < rounding && s > -rounding) return constant_math::SineCosine{0, c > 0 ? 1.0 : -1.0};
    if (c < rounding && c > -rounding) return constant_math::SineCosine{s > 0 ? 1.0 : -1.0, 0};
    return constant_math::SineCosine{s, c};
  };
  const auto [sr, cr] = sine_cosine(rpy.x);
  const auto [sp, cp] = sine_cosine(rpy.y);
  const auto [sy, cy] = sine_cosine(rpy.z);
  return {{{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
            {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
            {-sp, cp * sr, cp * cr}}}};
}

/// The vector of length 1 that points where another one does, which may be of any finite length.
/// @pre  a is not zero
[[nodiscard]] constexpr Vector3<double> direction_of(const Vector3<double>& a) noexcept {
  const auto size = [](double x) { return x < 0 ? -x : x; };
  double largest = size(a.x) > size(a.y) ? size(a.x) : size(a.y);
  if (size(a.z) > largest) largest = size(a.z);
  const Vector3<double> scaled{a.x / largest, a.y / largest, a.z / largest};  // squares stay finite
  return (1 / constant_math::square_root(dot(scaled, scaled))) * scaled;
}

/// A rotation that turns the z axis onto a direction. Along a coordinate axis it holds only 0, 1
/// and -1.
/// @param axis  a direction of length 1, dimensionless, 3 x 1
[[nodiscard]] constexpr Matrix3<double> rotation_of_z_onto(const Vector3<double>& axis) noexcept {
  const auto magnitude = [](double x) { return x < 0 ? -x : x; };
  // The coordinate direction after the axis' largest component is far from parallel to the axis.
  Vector3<double> helper{};
  if (magnitude(axis.z) >= magnitude(axis.x) && magnitude(axis.z) >= magnitude(axis.y)) {
    helper = {1, 0, 0};
  } else if (magnitude(axis.y) >= magnitude(axis.x)) {
    helper = {0, 0, 1};
  } else {
    helper = {0, 1, 0};
  }
  Vector3<double> y = cross(axis, helper);
  y = (1 / constant_math::square_root(dot(y, y))) * y;
  return Matrix3<double>{{{cross(y, axis), y, axis}}}.transposed();
}

}  // namespace articula
