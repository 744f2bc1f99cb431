// SPDX-License-Identifier: Apache-2.0
/// @file Forward dynamics by articulated bodies.
#pragma once

#include "articula/dynamics/nonlinear_effects.hpp"

#include <array>
#include <cstddef>

namespace articula {

namespace detail {

/// What a body with all that it carries opposes to an acceleration when the joints beyond it are
/// free to give way, about the origin of its frame: n = I alpha + H a, f = H^T alpha + M a.
template <class S>
struct ArticulatedInertia {
  Symmetric3<S> moment;  ///< I [kg m^2], 3 x 3
  Matrix3<S> coupling;   ///< H [kg m], 3 x 3
  Symmetric3<S> mass;    ///< M [kg], 3 x 3; a rigid body's is m 1
};

template <class S>
[[nodiscard]] constexpr ArticulatedInertia<S> articulated(const MassMoments<S>& body) noexcept {
  const auto& [m, h, j] = body;
  const S zero(0.0);
  return {{j.yy + j.zz, -j.xy, -j.xz, j.xx + j.zz, -j.yz, j.xx + j.yy},
          {{{{zero, -h.z, h.y}, {h.z, zero, -h.x}, {-h.y, h.x, zero}}}},
          {m, zero, zero, m, zero, m}};
}

/// A - x y^T.
/// @pre x and y are parallel, so that the result is symmetric
template <class S>
[[nodiscard]] constexpr Symmetric3<S> minus_product(const Symmetric3<S>& a, const Vector3<S>& x,
                                                    const Vector3<S>& y) noexcept {
  return {a.xx - x.x * y.x, a.xy - x.x * y.y, a.xz - x.x * y.z,
          a.yy - x.y * y.y, a.yz - x.y * y.z, a.zz - x.z * y.z};
}

/// The columns of [t]x A, t x each column of A.
template <class S>
[[nodiscard]] constexpr Matrix3<S> cross_columns(const Vector3<S>& t,
                                                 const Matrix3<S>& a) noexcept {
  return Matrix3<S>{{{cross(t, a.column(0)), cross(t, a.column(1)), cross(t, a.column(2))}}}
      .transposed();
}

template <class S>
[[nodiscard]] constexpr Matrix3<S> full(const Symmetric3<S>& a) noexcept {
  return {{{{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}}}};
}

/// An articulated inertia in the frame of the parent. With t the translation, M and H turned become
/// M and H' = H + [t]x M, and I becomes I + [t]x H^T - H' [t]x.
template <class S>
[[nodiscard]] constexpr ArticulatedInertia<S> in_parent(const JointPlacement<S>& joint,
                                                        const ArticulatedInertia<S>& own) noexcept {
  const Vector3<S>& t = joint.translation;
  const Symmetric3<S> mass = joint.to_parent(own.mass);
  const Symmetric3<S> moment = joint.to_parent(own.moment);
  Matrix3<S> coupling = own.coupling.transposed();  // its rows are columns now
  for (Vector3<S>& column : coupling.rows) column = joint.to_parent(column);
  coupling = coupling.transposed();
  for (Vector3<S>& row : coupling.rows) row = joint.to_parent(row);

  const Matrix3<S> lever = cross_columns(t, coupling.transposed());  // [t]x H^T
  const Matrix3<S> shift = cross_columns(t, full(mass));             // [t]x M
  for (std::size_t i = 0; i < 3; ++i) coupling.rows[i] = coupling.rows[i] + shift.rows[i];
  // H' [t]x = -([t]x H'^T)^T
  const Matrix3<S> other = cross_columns(t, coupling.transposed()).transposed();
  const auto& [x, y, z] = lever.rows;
  const auto& [u, v, w] = other.rows;
  return {{moment.xx + x.x + u.x, moment.xy + x.y + u.y, moment.xz + x.z + u.z,
           moment.yy + y.y + v.y, moment.yz + y.z + v.z, moment.zz + z.z + w.z},
          coupling,
          mass};
}

}  // namespace detail

/// Forward dynamics once more, without a mass matrix: each body with those that it carries is
/// replaced by what it opposes to an acceleration, from the leaves to the base; from the base to
/// the leaves the accelerations follow. Velocities and gravity come in by the bias efforts. For
/// long chains that takes fewer operations than factors of the mass matrix.
/// Source: [Featherstone 2008, chapter 7].
struct ArticulatedBodies {
  /// Up to this length of a chain factors of the mass matrix have been seen to take fewer
  /// operations, on trees even beyond it.
  static constexpr int short_chain = 10;

  /// True for long chains, unless joints are tied otherwise than by the tree, which is beyond it.
  template <int N, int B>
  [[nodiscard]] static constexpr bool may_pay(const Mechanism<N, B>& mechanism) noexcept {
    int longest = 0;
    for (const Body& body : mechanism.bodies) {
      if (body.sharing_body >= 0) return false;
      int length = 1;
      for (int i = body.parent; i >= 0; i = mechanism.bodies[static_cast<std::size_t>(i)].parent) {
        ++length;
      }
      longest = length > longest ? length : longest;
    }
    return N == B && longest > short_chain;
  }

  /// @pre no mimic joints, no shared rotors
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(
      const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration,
      const JointArray<S, N>& v, const JointArray<S, N>& effort) noexcept {
    const JointArray<S, N> bias = NonlinearEffects::evaluate<S, N, B>(mechanism, configuration, v);
    JointArray<detail::ArticulatedInertia<S>, B> inertia;
    JointArray<Wrench<S>, B> wrench;      // that the efforts beyond a body exert on it
    JointArray<Wrench<S>, B> along;       // for a unit acceleration of the joint alone
    JointArray<S, B> inverse, remaining;  // 1/D, and the effort that is left to accelerate
    wrench.fill({});                      // g++ 12 leaves elements of large arrays uninitialised
    for (std::size_t i = 0; i < inertia.size(); ++i) {
      inertia[i] = detail::articulated(configuration[i].moments);
    }
    for (std::size_t i = inertia.size(); i-- > 0;) {
      const Body& body = mechanism.bodies[i];
      const detail::ArticulatedInertia<S>& own = inertia[i];
      const Matrix3<S> h = own.coupling, m = detail::full(own.mass), j = detail::full(own.moment);
      along[i] =
          body.prismatic ? Wrench<S>{m.rows[2], h.column(2)} : Wrench<S>{h.rows[2], j.rows[2]};
      const S felt = body.prismatic ? along[i].force.z : along[i].moment.z;
      inverse[i] = S(1.0) / (felt + S(body.reflected_inertia));
      remaining[i] =
          effort[i] - bias[i] - (body.prismatic ? wrench[i].force.z : wrench[i].moment.z);
      if (body.parent < 0) continue;
      const std::size_t p = detail::parent_of(body, i);
      const Vector3<S> force = inverse[i] * along[i].force, moment = inverse[i] * along[i].moment;
      detail::ArticulatedInertia<S> rest{detail::minus_product(own.moment, moment, along[i].moment),
                                         own.coupling,
                                         detail::minus_product(own.mass, force, along[i].force)};
      const S by_row[] = {moment.x, moment.y, moment.z};
      for (std::size_t k = 0; k < 3; ++k) {
        rest.coupling.rows[k] = rest.coupling.rows[k] - by_row[k] * along[i].force;
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
    JointArray<Vector3<S>, B> angular, linear;
    JointArray<S, N> a;
    for (std::size_t i = 0; i < inertia.size(); ++i) {
      const Body& body = mechanism.bodies[i];
      angular[i] = linear[i] = {};
      S carried(0.0);
      if (body.parent >= 0) {
        const std::size_t p = detail::parent_of(body, i);
        angular[i] = configuration[i].from_parent(angular[p]);
        linear[i] = configuration[i].from_parent(linear[p] +
                                                 cross(angular[p], configuration[i].translation));
        carried = dot(along[i].moment, angular[i]) + dot(along[i].force, linear[i]);
      }
      a[i] = inverse[i] * (remaining[i] - carried);
      S& own = body.prismatic ? linear[i].z : angular[i].z;
      own = own + a[i];
    }
    return a;
  }
};

}  // namespace articula
