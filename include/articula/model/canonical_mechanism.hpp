// SPDX-License-Identifier: Apache-2.0
/// @file An equivalent mechanism whose equations of motion are shorter.
///
/// A mechanism leaves choices open that its motion cannot feel: where on the joint's axis a body's
/// frame stands and how it is turned about it at rest, and on which side of a joint a part of the
/// mass counts that does not notice whether the joint moves. They are made here so that as many
/// numbers as possible become zero.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/model/mechanism.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

namespace articula {

/// What is taken for a right angle unless something else is asked for: the sine of the difference.
/// 1.5707963, a right angle written with eight digits, is off by 3e-8. One with fewer is taken as
/// it is written: other libraries would differ from what is made of it in the seventh digit.
inline constexpr double default_right_angle_tolerance = 1e-7;

/// A mechanism in canonical form, and how to come back from it.
template <int N, int Bodies = N>
struct CanonicalMechanism {
  /// Joints, positions, efforts and kinetic energy are those of the original.
  Mechanism<N, Bodies> mechanism{};
  /// The new frame of each body in its old one: a point at x in the new frame is at frames[i] x.
  std::array<Placement<double>, static_cast<std::size_t>(Bodies)> frames{};
  /// What the base has taken over, about the origin of the base frame. The potential energy of the
  /// original is that of the mechanism and of this.
  Inertia<double> base{};
};

namespace detail {

[[nodiscard]] constexpr double magnitude(double x) noexcept { return x < 0 ? -x : x; }

/// x, or 0 if it may be what rounding has left of a difference of numbers as large as `scale`: some
/// tens of operations, each off by 1e-16.
[[nodiscard]] constexpr double without_rounding(double x, double scale) noexcept {
  return magnitude(x) <= 1e-14 * scale ? 0 : x;
}

[[nodiscard]] constexpr Vector3<double> without_rounding(const Vector3<double>& a, double scale) {
  return {without_rounding(a.x, scale), without_rounding(a.y, scale), without_rounding(a.z, scale)};
}

[[nodiscard]] constexpr Symmetric3<double> without_rounding(const Symmetric3<double>& m,
                                                            double scale) {
  return {without_rounding(m.xx, scale), without_rounding(m.xy, scale),
          without_rounding(m.xz, scale), without_rounding(m.yy, scale),
          without_rounding(m.yz, scale), without_rounding(m.zz, scale)};
}

/// The components of a vector of length 1, zeros and ones among them exact.
[[nodiscard]] constexpr Vector3<double> with_exact_components(const Vector3<double>& unit) {
  const auto exact = [](double x) {
    const double sign = x < 0 ? -1 : 1;
    return without_rounding(x - sign, 1) == 0 ? sign : without_rounding(x, 1);
  };
  return {exact(unit.x), exact(unit.y), exact(unit.z)};
}

/// A direction of length 1, with exact zeros and ones.
[[nodiscard]] constexpr Vector3<double> direction(const Vector3<double>& a) {
  return with_exact_components((1 / constant_math::square_root(dot(a, a))) * a);
}

/// The rotation with all elements up to the tolerance in size taken as zero, made orthonormal
/// again: the z axis keeps its direction, x is turned until it is perpendicular to it. Small
/// elements that are larger say that the angle is what it is; to take the smallest of them for zero
/// alone would be neither the one nor the other. Then no more than rounding is taken away.
[[nodiscard]] constexpr Matrix3<double> with_right_angles(Matrix3<double> rotation,
                                                          double tolerance) {
  const double small = std::min(100 * tolerance, 1e-3);
  bool meant = false;
  for (const Vector3<double>& row : rotation.rows) {
    for (const double element : {row.x, row.y, row.z}) {
      meant = meant || (magnitude(element) > tolerance && magnitude(element) <= small);
    }
  }
  const double zero = meant ? std::min(tolerance, 1e-14) : tolerance;
  for (Vector3<double>& row : rotation.rows) {
    for (double* element : {&row.x, &row.y, &row.z}) {
      if (magnitude(*element) <= zero) *element = 0;
    }
  }
  const Vector3<double> z = direction(rotation.column(2));
  const Vector3<double> y = direction(cross(z, rotation.column(0)));
  return Matrix3<double>{{{direction(cross(y, z)), y, z}}}.transposed();
}

[[nodiscard]] constexpr Matrix3<double> turn_about_z(double sine, double cosine) {
  return {{{{cosine, -sine, 0}, {sine, cosine, 0}, {0, 0, 1}}}};
}

/// Moves the frame of one body along and about its z axis, which no joint can feel.
/// @param move  the new frame in the old one: a turn about z and a translation along z
template <int N, int Bodies>
constexpr void move_frame(CanonicalMechanism<N, Bodies>& canonical, std::size_t index,
                          const Placement<double>& move) {
  const Matrix3<double> back = move.rotation.transposed();
  const Placement<double> old_in_new{back, back * -move.translation};
  Body& body = canonical.mechanism.bodies[index];
  body.placement = body.placement * move;
  body.inertia = moved(old_in_new, body.inertia);
  canonical.frames[index] = canonical.frames[index] * move;
  for (Body& child : canonical.mechanism.bodies) {
    if (child.parent == static_cast<int>(index)) child.placement = old_in_new * child.placement;
  }
}

/// How to turn a body's frame about its z axis so that its rotation in the parent's has more zeros.
/// A rotation is Rz(a) Rx(b) Rz(c). Where the axes are parallel, a and c are taken away, so that
/// the identity is left, or a half turn about x. Else c is, unless that row holds a zero already.
[[nodiscard]] constexpr Matrix3<double> untwist(const Matrix3<double>& rotation) {
  const Vector3<double>& last = rotation.rows[2];
  if (last.x == 0 && last.y == 0) {  // z alone is 1 already where x is 1e-8
    const double sign = last.z < 0 ? -1 : 1;
    const Matrix3<double> straight{{{{1, 0, 0}, {0, sign, 0}, {0, 0, sign}}}};
    return rotation.transposed() * straight;
  }
  if (last.x == 0 || last.y == 0) return Matrix3<double>::identity();
  const double length = constant_math::square_root(last.x * last.x + last.y * last.y);
  return turn_about_z(-last.x / length, last.y / length);
}

/// The part of a body's inertia that the motion of its joint cannot tell from the parent's. For a
/// revolute joint that is what lies on its axis as a thin rod does: mass, first moment and second
/// moment along z, (Ixx + Iyy - Izz)/2. For a prismatic one it is the whole moment of inertia.
/// Source: [Khalil, Dombre 2002, section 9.4.2], there with Iyy for the second moment along z.
[[nodiscard]] constexpr Inertia<double> unfelt_part(const Body& body) {
  const Symmetric3<double>& i = body.inertia.moment;
  if (body.prismatic) return {0, {}, i};
  const double along_z = (i.xx + i.yy - i.zz) / 2;
  return {body.inertia.mass, {0, 0, body.inertia.first_moment.z}, {along_z, 0, 0, along_z, 0, 0}};
}

/// What is left of a body's inertia without its unfelt part.
[[nodiscard]] constexpr Inertia<double> felt_part(const Body& body) {
  const Inertia<double>& all = body.inertia;
  const Symmetric3<double>& i = all.moment;
  const double scale = i.xx + i.yy + i.zz;
  const double moment_scale = constant_math::square_root(all.mass * scale);  // |h|^2 <= m trace(I)
  if (body.prismatic) return {all.mass, without_rounding(all.first_moment, moment_scale), {}};
  const Inertia<double> unfelt = unfelt_part(body);
  const Vector3<double> h{all.first_moment.x, all.first_moment.y, 0};
  Symmetric3<double> moment = without_rounding(
      {i.xx - unfelt.moment.xx, i.xy, i.xz, i.yy - unfelt.moment.yy, i.yz, 0}, scale);
  moment.zz = moment.xx + moment.yy;
  return {0, without_rounding(h, moment_scale), moment};
}

}  // namespace detail

/// The canonical form of a mechanism.
///
/// 1. Right angles that were written with few digits become exact: elements of rotation matrices
///    up to `right_angle_tolerance` in size become 0, unless some are only little larger, and the
///    matrices are made orthonormal again. This changes efforts in proportion to how far off the
///    angles were, and accelerations by that times the condition of the mass matrix; 0 turns it
///    off.
/// 2. Frames are turned about their z axes so that rotations have more zeros, and axes that are
///    parallel have the same frame.
/// 3. Origins slide along their joints' axes to where the parent's origin is nearest.
/// 4. From the leaves to the base, the part of each inertia that its joint cannot feel goes to the
///    parent. What is left are base inertial parameters, and no longer the inertia of a real body.
///
/// Steps 2 to 4 change kinetic energy and efforts by no more than rounding.
/// @param mechanism              bodies in frames whose z axis is the joint's axis
/// @param right_angle_tolerance  dimensionless; 0 leaves matrices as they are written
/// @throws std::invalid_argument if the tolerance is not within 0 .. 0.1
/// Real-time: no (set-up or compile time). O(N^2).
template <int N, int Bodies>
[[nodiscard]] constexpr CanonicalMechanism<N, Bodies> canonical_form(
    const Mechanism<N, Bodies>& mechanism,
    double right_angle_tolerance = default_right_angle_tolerance) {
  CanonicalMechanism<N, Bodies> canonical{.mechanism = mechanism, .frames = {}, .base = {}};
  auto& bodies = canonical.mechanism.bodies;
  if (!(right_angle_tolerance >= 0 && right_angle_tolerance <= 0.1)) {
    throw std::invalid_argument("right_angle_tolerance is not within 0 .. 0.1");
  }
  if (right_angle_tolerance > 0) {
    for (Body& body : bodies) {
      body.placement.rotation =
          detail::with_right_angles(body.placement.rotation, right_angle_tolerance);
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].parent < 0) continue;
    Matrix3<double>& rotation = bodies[i].placement.rotation;
    detail::move_frame(canonical, i, {detail::untwist(rotation), {}});
    for (Vector3<double>& row : rotation.rows) row = detail::with_exact_components(row);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Placement<double>& placement = bodies[i].placement;
    const double scale =
        constant_math::square_root(dot(placement.translation, placement.translation));
    const double along_axis = dot(placement.rotation.column(2), placement.translation);
    detail::move_frame(canonical, i, {Matrix3<double>::identity(), {0, 0, -along_axis}});
    bodies[i].placement.translation =
        detail::without_rounding(bodies[i].placement.translation, scale);
  }
  for (std::size_t i = bodies.size(); i-- > 0;) {
    const Inertia<double> part = moved(bodies[i].placement, detail::unfelt_part(bodies[i]));
    Inertia<double>& parent = bodies[i].parent < 0
                                  ? canonical.base
                                  : bodies[static_cast<std::size_t>(bodies[i].parent)].inertia;
    parent = parent + part;
    bodies[i].inertia = detail::felt_part(bodies[i]);
  }
  return canonical;
}

}  // namespace articula
