// SPDX-License-Identifier: Apache-2.0
/// @file The mass distribution of a rigid body.
#pragma once

#include "articula/model/placement.hpp"
#include "articula/model/vector3.hpp"

namespace articula {

/// The ten inertial parameters of a rigid body about the origin of its frame. They determine its
/// dynamics, and they add up when bodies are welded together.
template <class S>
struct Inertia {
  S mass = S(0.0);            ///< m [kg]
  Vector3<S> first_moment{};  ///< h = m c, with c the centre of mass [kg m], 3 x 1
  Symmetric3<S> moment{};     ///< I, inertia about the frame's origin [kg m^2], 3 x 3

  friend constexpr Inertia operator+(const Inertia& a, const Inertia& b) {
    return {a.mass + b.mass, a.first_moment + b.first_moment, a.moment + b.moment};
  }
};

/// 2 (a . b) 1 - (a b^T + b a^T): the contribution of a first moment a to the inertia about an
/// origin at a distance b. With a = m b / 2 it is the parallel-axis term of a point mass m at b.
template <class S>
[[nodiscard]] constexpr Symmetric3<S> parallel_axis(const Vector3<S>& a, const Vector3<S>& b) {
  const Vector3<S> twice = b + b;
  const S x = a.x * twice.x, y = a.y * twice.y, z = a.z * twice.z;
  return {y + z, -(a.x * b.y + a.y * b.x), -(a.x * b.z + a.z * b.x),
          x + z, -(a.y * b.z + a.z * b.y), x + y};
}

/// R I R^T for symmetric I.
template <class S>
[[nodiscard]] constexpr Symmetric3<S> rotated(const Matrix3<S>& rotation, const Symmetric3<S>& i) {
  const Matrix3<S>& r = rotation;
  const std::array<Vector3<S>, 3> ir{i * r.rows[0], i * r.rows[1], i * r.rows[2]};
  return {dot(r.rows[0], ir[0]), dot(r.rows[0], ir[1]), dot(r.rows[0], ir[2]),
          dot(r.rows[1], ir[1]), dot(r.rows[1], ir[2]), dot(r.rows[2], ir[2])};
}

/// A body's inertia in frame A from that in frame B, with the translation t and h_A = R h_B. The
/// first moment is h_A + m t. The moment is R I_B R^T + 2 (a . t) 1 - (a t^T + t a^T) where a = h_A
/// + m t / 2.
/// Source: [Featherstone 2008, section 2.13], written out in blocks.
/// @param ab       the placement of B in A
/// @param inertia  the body's inertia in B
template <class S>
[[nodiscard]] constexpr Inertia<S> moved(const Placement<S>& ab, const Inertia<S>& inertia) {
  const Vector3<S> h = ab.rotation * inertia.first_moment;
  const Vector3<S> half_shift = (S(0.5) * inertia.mass) * ab.translation;
  return {inertia.mass, h + (half_shift + half_shift),
          rotated(ab.rotation, inertia.moment) + parallel_axis(h + half_shift, ab.translation)};
}

}  // namespace articula
