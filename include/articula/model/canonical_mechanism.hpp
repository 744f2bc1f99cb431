// SPDX-License-Identifier: Apache-2.0
/// @file An equivalent mechanism whose equations of motion are shorter.
///
/// Some parameters of a mechanism can be chosen without a change of its motion. They are the
/// position of a body's frame on its joint's axis, and its angle about that axis. A third is the
/// side of the joint on which a part of the inertia is counted. The canonical form chooses them so
/// that as many numbers as possible become zero.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/model/mechanism.hpp"

#include <algorithm>
#include <stdexcept>

namespace articula {

/// The default tolerance for right angles: the sine of the difference. 1.5707963, a right angle
/// written with eight digits, is off by 3e-8. An angle with fewer digits is used as it is written:
/// otherwise results would differ from other libraries' in the seventh digit.
inline constexpr double default_right_angle_tolerance = 1e-7;

/// A mechanism in canonical form, and its relation to the original.
template <int N, int Bodies = N>
struct CanonicalMechanism {
  /// Its joints, positions, efforts and kinetic energy equal those of the original.
  Mechanism<N, Bodies> mechanism{};
  /// The new frame of each body in its old one: a point at x in the new frame is at frames[i] x.
  JointArray<Placement<double>, Bodies> frames{};
  /// Inertia moved to the base, about the origin of the base frame. The potential energy of the
  /// original is that of the mechanism and of this inertia.
  Inertia<double> base{};
};

namespace detail {

/// x, or 0 if x may be a rounding error of a difference of numbers as large as `scale`. The
/// tolerance covers some tens of operations, each with an error of 1e-16.
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

/// A vector of length 1 with components near 0, 1 and -1 made exact.
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

/// The rotation with all elements up to the tolerance set to zero, made orthonormal again. The z
/// axis keeps its direction, and x is made perpendicular to it. If other elements are small but
/// above the tolerance, the small angle is probably intended. Then only rounding is removed.
[[nodiscard]] constexpr Matrix3<double> with_right_angles(Matrix3<double> rotation,
                                                          double tolerance) {
  const double small = std::min(100 * tolerance, 1e-3);
  bool is_intended = false;
  for (const Vector3<double>& row : rotation.rows) {
    for (const double element : {row.x, row.y, row.z}) {
      is_intended = is_intended || (magnitude(element) > tolerance && magnitude(element) <= small);
    }
  }
  const double zero = is_intended ? std::min(tolerance, 1e-14) : tolerance;
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

/// Moves the frame of one body along and about its z axis, without a change of the motion.
/// @param move  the new frame in the old one: a rotation about z and a translation along z
template <int N, int Bodies>
constexpr void move_frame(CanonicalMechanism<N, Bodies>& canonical, int index,
                          const Placement<double>& move) {
  const Matrix3<double> back = move.rotation.transposed();
  const Placement<double> old_in_new{back, back * -move.translation};
  Body& body = canonical.mechanism.bodies[index];
  body.placement = body.placement * move;
  body.inertia = moved(old_in_new, body.inertia);
  canonical.frames[index] = canonical.frames[index] * move;
  for (Body& child : canonical.mechanism.bodies) {
    if (child.parent == index) child.placement = old_in_new * child.placement;
  }
}

/// A rotation of a body's frame about its z axis that gives its rotation in the parent's more
/// zeros. A rotation is Rz(a) Rx(b) Rz(c). If the axes are parallel, a and c are removed, which
/// leaves the identity or a half turn about x. Otherwise c is removed, unless that row has a zero
/// already.
[[nodiscard]] constexpr Matrix3<double> untwist(const Matrix3<double>& rotation) {
  const Vector3<double>& last = rotation.rows[2];
  if (last.x == 0 && last.y == 0) {  // z alone would be 1 already at x = 1e-8
    const double sign = last.z < 0 ? -1 : 1;
    const Matrix3<double> straight{{{{1, 0, 0}, {0, sign, 0}, {0, 0, sign}}}};
    return rotation.transposed() * straight;
  }
  if (last.x == 0 || last.y == 0) return Matrix3<double>::identity();
  const double length = constant_math::square_root(last.x * last.x + last.y * last.y);
  return turn_about_z(-last.x / length, last.y / length);
}

/// The part of a body's inertia that can be regrouped with the parent's without a change of the
/// motion. For a revolute joint it is that of a thin rod on its axis: mass, first moment and second
/// moment along z, (Ixx + Iyy - Izz)/2. For a prismatic joint it is the whole moment of inertia.
/// Source: [Khalil, Dombre 2002, section 9.4.2], there with Iyy for the second moment along z.
[[nodiscard]] constexpr Inertia<double> regrouped_part(const Body& body) {
  const Symmetric3<double>& i = body.inertia.moment;
  if (body.prismatic) return {0, {}, i};
  const double along_z = (i.xx + i.yy - i.zz) / 2;
  return {body.inertia.mass, {0, 0, body.inertia.first_moment.z}, {along_z, 0, 0, along_z, 0, 0}};
}

/// A body's inertia without its regrouped part.
[[nodiscard]] constexpr Inertia<double> remaining_part(const Body& body) {
  const Inertia<double>& all = body.inertia;
  const Symmetric3<double>& i = all.moment;
  const double scale = i.xx + i.yy + i.zz;
  const double moment_scale = constant_math::square_root(all.mass * scale);  // |h|^2 <= m trace(I)
  if (body.prismatic) return {all.mass, without_rounding(all.first_moment, moment_scale), {}};
  const Inertia<double> regrouped = regrouped_part(body);
  const Vector3<double> h{all.first_moment.x, all.first_moment.y, 0};
  Symmetric3<double> moment = without_rounding(
      {i.xx - regrouped.moment.xx, i.xy, i.xz, i.yy - regrouped.moment.yy, i.yz, 0}, scale);
  moment.zz = moment.xx + moment.yy;
  return {0, without_rounding(h, moment_scale), moment};
}

}  // namespace detail

/// The canonical form of a mechanism.
///
/// 1. Right angles that were written with few digits become exact. Elements of rotation matrices up
///    to `right_angle_tolerance` become 0, unless some are only little larger. The matrices are
///    made orthonormal again. Efforts change in proportion to the angles' error, accelerations by
///    that times the condition of the mass matrix. A tolerance of 0 turns this step off.
/// 2. Frames are rotated about their z axes so that rotations have more zeros, and parallel axes
///    have frames of the same orientation.
/// 3. Origins move along their joints' axes to the point nearest to the parent's origin.
/// 4. From the leaves to the base, the regrouped part of each inertia is added to the parent's. The
///    remaining base inertial parameters are not those of a real body.
///
/// Steps 2 to 4 change kinetic energy and efforts by rounding only.
/// @param mechanism              bodies in frames whose z axis is the joint's axis
/// @param right_angle_tolerance  dimensionless; 0 keeps the angles as they are written
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
  for (int i = 0; i < Bodies; ++i) {
    if (bodies[i].parent < 0) continue;
    Matrix3<double>& rotation = bodies[i].placement.rotation;
    detail::move_frame(canonical, i, {detail::untwist(rotation), {}});
    for (Vector3<double>& row : rotation.rows) row = detail::with_exact_components(row);
  }
  for (int i = 0; i < Bodies; ++i) {
    const Placement<double>& placement = bodies[i].placement;
    const double scale =
        constant_math::square_root(dot(placement.translation, placement.translation));
    const double along_axis = dot(placement.rotation.column(2), placement.translation);
    detail::move_frame(canonical, i, {Matrix3<double>::identity(), {0, 0, -along_axis}});
    bodies[i].placement.translation =
        detail::without_rounding(bodies[i].placement.translation, scale);
  }
  for (int i = Bodies; i-- > 0;) {
    const Inertia<double> part = moved(bodies[i].placement, detail::regrouped_part(bodies[i]));
    Inertia<double>& parent =
        bodies[i].parent < 0 ? canonical.base : bodies[bodies[i].parent].inertia;
    parent = parent + part;
    bodies[i].inertia = detail::remaining_part(bodies[i]);
  }
  return canonical;
}

}  // namespace articula
