// SPDX-License-Identifier: Apache-2.0
/// @file The position and orientation of a frame in another.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/model/vector3.hpp"

#include <algorithm>

namespace articula {

/// The placement of frame B in frame A: x_A = rotation x_B + translation.
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
/// Rx(roll). Sines and cosines within 1e-15 of 0 are set to 0. So a right angle written as the
/// double nearest to pi/2 gives exact zeros and ones.
/// @param rpy  roll, pitch, yaw [rad], 3 x 1; by value, because g++ 12 misreads a reference to a
///             part of a constant that a function has filled member by member
[[nodiscard]] constexpr Matrix3<double> rotation_from_rpy(Vector3<double> rpy) noexcept {
  const auto sine_cosine = [](double angle) {
    auto [s, c] = constant_math::sine_cosine(angle);
    constexpr double rounding = 1e-15;  // that of an angle near pi is half of 2^-52 pi
    if (detail::magnitude(s) < rounding) return constant_math::SineCosine{0, c > 0 ? 1.0 : -1.0};
    if (detail::magnitude(c) < rounding) return constant_math::SineCosine{s > 0 ? 1.0 : -1.0, 0};
    return constant_math::SineCosine{s, c};
  };
  const auto [sr, cr] = sine_cosine(rpy.x);
  const auto [sp, cp] = sine_cosine(rpy.y);
  const auto [sy, cy] = sine_cosine(rpy.z);
  return {{{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
            {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
            {-sp, cp * sr, cp * cr}}}};
}

/// The vector of length 1 in the direction of another vector of any finite length.
/// @pre  a is not zero
[[nodiscard]] constexpr Vector3<double> direction_of(const Vector3<double>& a) noexcept {
  const double largest =
      std::max({detail::magnitude(a.x), detail::magnitude(a.y), detail::magnitude(a.z)});
  const Vector3<double> scaled{a.x / largest, a.y / largest, a.z / largest};  // squares stay finite
  return (1 / constant_math::square_root(dot(scaled, scaled))) * scaled;
}

/// A rotation of the z axis onto a direction. For a coordinate axis its elements are 0, 1 and -1.
/// @param axis  a direction of length 1, dimensionless, 3 x 1
[[nodiscard]] constexpr Matrix3<double> rotation_of_z_onto(const Vector3<double>& axis) noexcept {
  using detail::magnitude;
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
