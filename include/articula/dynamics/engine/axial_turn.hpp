// SPDX-License-Identifier: Apache-2.0
/// @file Turns about the z axis, the axis of every joint.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/dynamics/engine/mass_moments.hpp"

#include <cmath>
#include <concepts>
#include <type_traits>

namespace articula {

/// A turn about z.
template <class S>
struct AxialTurn {
  S sine = S(0.0);
  S cosine = S(1.0);

  [[nodiscard]] constexpr Vector3<S> operator()(const Vector3<S>& x) const noexcept {
    return {cosine * x.x - sine * x.y, sine * x.x + cosine * x.y, x.z};
  }
  [[nodiscard]] constexpr Vector3<S> back(const Vector3<S>& x) const noexcept {
    return {cosine * x.x + sine * x.y, cosine * x.y - sine * x.x, x.z};
  }
  /// Rz A Rz^T. With k = s (xx - yy) + 2 c xy the elements become xx - s k, yy + s k and c k - xy.
  [[nodiscard]] constexpr Symmetric3<S> operator()(const Symmetric3<S>& a) const noexcept {
    const S k = sine * (a.xx - a.yy) + cosine * (a.xy + a.xy), shift = sine * k;
    return {a.xx - shift, cosine * k - a.xy,           cosine * a.xz - sine * a.yz,
            a.yy + shift, sine * a.xz + cosine * a.yz, a.zz};
  }
  [[nodiscard]] constexpr MassMoments<S> operator()(const MassMoments<S>& m) const noexcept {
    return {m.mass, (*this)(m.first), (*this)(m.second)};
  }
};

/// A turn about z followed by a rotation, as a matrix: R Rz.
template <class S>
[[nodiscard]] constexpr Matrix3<S> turned(const Matrix3<S>& rotation,
                                          const AxialTurn<S>& turn) noexcept {
  const Vector3<S> x = rotation.column(0), y = rotation.column(1);
  const S &s = turn.sine, &c = turn.cosine;
  return Matrix3<S>{{{c * x + s * y, c * y - s * x, rotation.column(2)}}}.transposed();
}

namespace detail {

/// The turn about z by an angle [rad], at compile time and at run time.
template <class S>
[[nodiscard]] constexpr AxialTurn<S> turn_by(const S& angle) noexcept {
  if constexpr (std::same_as<S, double>) {
    if (std::is_constant_evaluated()) {
      const auto [sine, cosine] = constant_math::sine_cosine(angle);
      return {sine, cosine};
    }
  }
  if constexpr (requires { sincos(angle); }) {
    const auto [sine, cosine] = sincos(angle);
    return {sine, cosine};
  } else {
    using std::cos, std::sin;
    return {sin(angle), cos(angle)};
  }
}

}  // namespace detail

}  // namespace articula
