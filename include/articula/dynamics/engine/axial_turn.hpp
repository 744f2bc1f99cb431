// SPDX-License-Identifier: Apache-2.0
/// @file Mass moments of a body, and turns about the z axis, the axis of every joint.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/model/inertia.hpp"

#include <cmath>
#include <concepts>
#include <type_traits>

namespace articula {

/// The mass distribution of a body by its moments about the origin of a frame. The second moment
/// turns and shifts independently of its trace, unlike the inertia. Its part along the joint's axis
/// is zero in a canonical mechanism.
template <class S>
struct MassMoments {
  S mass = S(0.0);         ///< m [kg]
  Vector3<S> first{};      ///< h = integral of r dm [kg m], 3 x 1
  Symmetric3<S> second{};  ///< J = integral of r r^T dm = trace(I)/2 1 - I [kg m^2], 3 x 3

  friend constexpr MassMoments operator+(const MassMoments& a, const MassMoments& b) noexcept {
    return {a.mass + b.mass, a.first + b.first, a.second + b.second};
  }
};

/// The moments of an inertia.
template <class S>
[[nodiscard]] constexpr MassMoments<S> moments_of(const Inertia<double>& inertia) noexcept {
  const Symmetric3<double>& i = inertia.moment;
  return {S(inertia.mass),
          constant<S>(inertia.first_moment),
          {S((i.yy + i.zz - i.xx) / 2), S(-i.xy), S(-i.xz), S((i.xx + i.zz - i.yy) / 2), S(-i.yz),
           S((i.xx + i.yy - i.zz) / 2)}};
}

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
