// SPDX-License-Identifier: Apache-2.0
/// @file Forward dynamics by articulated bodies.
#pragma once

#include "articula/dynamics/nonlinear_effects.hpp"

#include <cstddef>

namespace articula {

namespace detail {

/// The inertia of a body and of all that it carries on free joints, about the origin of its frame.
/// n = I alpha + H a, f = H^T alpha + M a.
template <class S>
struct ArticulatedInertia {
  Symmetric3<S> moment;  ///< I [kg m^2], 3 x 3
  Matrix3<S> coupling;   ///< H [kg m], 3 x 3
  Symmetric3<S> mass;    ///< M [kg], 3 x 3; a rigid body's is m 1
};

template <class S>
[[nodiscard, gnu::always_inline]] constexpr ArticulatedInertia<S> articulated(
    const MassMoments<S>& body) noexcept {
  const auto& [m, h, j] = body;
  const S zero(0.0);
  return {{j.yy + j.zz, -j.xy, -j.xz, j.xx + j.zz, -j.yz, j.xx + j.yy},
          {{{{zero, -h.z, h.y}, {h.z, zero, -h.x}, {-h.y, h.x, zero}}}},
          {m, zero, zero, m, zero, m}};
}

/// A - x y^T.
/// @pre x and y are parallel, so that the result is symmetric
template <class S>
[[nodiscard, gnu::always_inline]] constexpr Symmetric3<S> minus_product(
    const Symmetric3<S>& a, const Vector3<S>& x, const Vector3<S>& y) noexcept {
  return {a.xx - x.x * y.x, a.xy - x.x * y.y, a.xz - x.x * y.z,
          a.yy - x.y * y.y, a.yz - x.y * y.z, a.zz - x.z * y.z};
}

/// [t]x A, by rows.
template <class S>
[[nodiscard, gnu::always_inline]] constexpr Matrix3<S> cross_matrix(const Vector3<S>& t,
                                                                    const Matrix3<S>& a) noexcept {
  const auto& [x, y, z] = a.rows;
  return {{{t.y * z - t.z * y, t.z * x - t.x * z, t.x * y - t.y * x}}};
}

template <class S>
[[nodiscard, gnu::always_inline]] constexpr Matrix3<S> full(const Symmetric3<S>& a) noexcept {
  return {{{{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}}}};
}

/// An articulated inertia in the frame of the parent. With t the translation, M and H turned become
/// M and H' = H + [t]x M, and I becomes I + [t]x H^T - H' [t]x.
template <class S>
[[nodiscard, gnu::always_inline]] constexpr ArticulatedInertia<S> in_parent(
    const JointPlacement<S>& joint, const ArticulatedInertia<S>& own) noexcept {
  const Vector3<S>& t = joint.translation;
  const Symmetric3<S> mass = joint.to_parent(own.mass);
  const Symmetric3<S> moment = joint.to_parent(own.moment);
  Matrix3<S> coupling = own.coupling.transposed();  // its rows are columns now
  for (Vector3<S>& column : coupling.rows) column = joint.to_parent(column);
  coupling = coupling.transposed();
  for (Vector3<S>& row : coupling.rows) row = joint.to_parent(row);

  const Matrix3<S> lever = cross_matrix(t, coupling.transposed());  // [t]x H^T
  const Matrix3<S> shift = cross_matrix(t, full(mass));             // [t]x M
  for (std::size_t i = 0; i < 3; ++i) coupling.rows[i] = coupling.rows[i] + shift.rows[i];
  // H' [t]x = -([t]x H'^T)^T
  Matrix3<S> other;
  for (std::size_t i = 0; i < 3; ++i) other.rows[i] = cross(t, coupling.rows[i]);
  const auto& [x, y, z] = lever.rows;
  const auto& [u, v, w] = other.rows;
  return {{moment.xx + x.x + u.x, moment.xy + x.y + u.y, moment.xz + x.z + u.z,
           moment.yy + y.y + v.y, moment.yz + y.z + v.z, moment.zz + z.z + w.z},
          coupling,
          mass};
}

}  // namespace detail

/// Forward dynamics by articulated bodies, without a mass matrix. From the leaves to the base, each
/// body and those that it carries are replaced by their articulated inertia. From the base to the
/// leaves, the accelerations follow. The bias efforts contain velocities and gravity. For long
/// chains this takes fewer operations than factors of the mass matrix. Source: [Featherstone 2008,
/// chapter 7].
struct ArticulatedBodies {
  /// Up to this length of a chain, factors of the mass matrix took fewer operations in
  /// measurements; for trees even beyond it.
  static constexpr int short_chain = 10;

  /// True for long chains. False if mimic joints or shared rotors couple joints.
  template <int N, int B>
  [[nodiscard]] static constexpr bool may_pay(const Mechanism<N, B>& mechanism) noexcept {
    int longest = 0;
    for (const Body& body : mechanism.bodies) {
      if (body.sharing_body >= 0) return false;
      int length = 1;
      for (int i = body.parent; i >= 0; i = mechanism.bodies[i].parent) {
        ++length;
      }
      longest = length > longest ? length : longest;
    }
    return N == B && longest > short_chain;
  }

  /// Whether it is faster than the factors for a model loaded at run time, without known zeros. The
  /// time of the factors is proportional to the sum of the squared depths of the bodies, plus N^2
  /// for the matrix. The time of this algorithm is proportional to N. Both take about the same time
  /// for chains of twelve joints and for trees of twenty to thirty; the constants are fitted to
  /// times there.
  template <int N, int B>
  [[nodiscard]] static constexpr bool pays_for_numbers(const Mechanism<N, B>& mechanism) noexcept {
    constexpr double per_body = 73, per_element = 1.6;  // relative to the time of a squared depth
    JointArray<int, B> depth;
    int squares = 0;
    for (int i = 0; i < B; ++i) {
      const Body& body = mechanism.bodies[i];
      if (body.sharing_body >= 0) return false;
      depth[i] = body.parent < 0 ? 1 : depth[detail::parent_of(body, i)] + 1;
      squares += depth[i] * depth[i];
    }
    return N == B && squares + per_element * N * N > per_body * N;
  }
  /// The smallest model for which pays_for_numbers may be true.
  static constexpr int smallest_model = 12;

  /// @pre no mimic joints, no shared rotors
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(
      const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration,
      const JointArray<S, N>& v, const JointArray<S, N>& effort) noexcept {
    const JointArray<S, N> bias = NonlinearEffects::evaluate<S, N, B>(mechanism, configuration, v);
    detail::UnsetArray<detail::ArticulatedInertia<S>, B> inertia;
    detail::UnsetArray<Wrench<S>, B> wrench;  // on a body, by the efforts of the joints beyond it
    detail::UnsetArray<Wrench<S>, B> unit;    // for a unit acceleration of the joint alone
    JointArray<S, B> inverse, remaining;      // 1/D, and the effort that accelerates the joint
    for (int i = 0; i < B; ++i) {
      inertia.set(i, detail::articulated(configuration[i].moments));
      wrench.set(i, {});
    }
    for (int i = B; i-- > 0;) {
      const Body& body = mechanism.bodies[i];
      const detail::ArticulatedInertia<S>& own = inertia[i];
      const Matrix3<S> h = own.coupling, m = detail::full(own.mass), j = detail::full(own.moment);
      unit.set(
          i, body.prismatic ? Wrench<S>{m.rows[2], h.column(2)} : Wrench<S>{h.rows[2], j.rows[2]});
      const S pivot = body.prismatic ? unit[i].force.z : unit[i].moment.z;
      inverse[i] = S(1.0) / (pivot + configuration[i].reflected_inertia);
      remaining[i] =
          effort[i] - bias[i] - (body.prismatic ? wrench[i].force.z : wrench[i].moment.z);
      if (body.parent < 0) continue;
      const int p = detail::parent_of(body, i);
      const Vector3<S> force = inverse[i] * unit[i].force, moment = inverse[i] * unit[i].moment;
      detail::ArticulatedInertia<S> rest{detail::minus_product(own.moment, moment, unit[i].moment),
                                         own.coupling,
                                         detail::minus_product(own.mass, force, unit[i].force)};
      const S by_row[] = {moment.x, moment.y, moment.z};
      for (std::size_t k = 0; k < 3; ++k) {
        rest.coupling.rows[k] = rest.coupling.rows[k] - by_row[k] * unit[i].force;
      }
      const detail::ArticulatedInertia<S> moved = detail::in_parent(configuration[i], rest);
      detail::ArticulatedInertia<S>& parent = inertia[p];
      parent.moment = parent.moment + moved.moment;
      parent.mass = parent.mass + moved.mass;
      for (std::size_t k = 0; k < 3; ++k) {
        parent.coupling.rows[k] = parent.coupling.rows[k] + moved.coupling.rows[k];
      }
      const Vector3<S> f = configuration[i].to_parent(wrench[i].force + remaining[i] * force);
      wrench[p].force = wrench[p].force + f;
      wrench[p].moment = wrench[p].moment +
                         configuration[i].to_parent(wrench[i].moment + remaining[i] * moment) +
                         cross(configuration[i].translation, f);
    }
    detail::UnsetArray<Vector3<S>, B> angular, linear;
    JointArray<S, N> a;
    for (int i = 0; i < B; ++i) {
      const Body& body = mechanism.bodies[i];
      Vector3<S> turning{}, moving{};
      S carried(0.0);
      if (body.parent >= 0) {
        const int p = detail::parent_of(body, i);
        turning = configuration[i].from_parent(angular[p]);
        moving = configuration[i].from_parent(linear[p] +
                                              cross(angular[p], configuration[i].translation));
        carried = dot(unit[i].moment, turning) + dot(unit[i].force, moving);
      }
      a[i] = inverse[i] * (remaining[i] - carried);
      S& own = body.prismatic ? moving.z : turning.z;
      own = own + a[i];
      angular.set(i, turning);
      linear.set(i, moving);
    }
    return a;
  }
};

}  // namespace articula
