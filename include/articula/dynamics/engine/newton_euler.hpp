// SPDX-License-Identifier: Apache-2.0
/// @file The recursive Newton-Euler algorithm.
#pragma once

#include "articula/dynamics/engine/configuration.hpp"
#include "articula/dynamics/engine/unset_array.hpp"
#include "articula/dynamics/engine/wrench.hpp"
#include "articula/model/mechanism.hpp"

namespace articula {

namespace detail {

/// The motion of a body, in its own frame. Gravity acts as an upward acceleration of the base, so
/// that every acceleration includes the weight.
template <class S>
struct BodyMotion {
  Vector3<S> angular_velocity{};      ///< w [rad/s], 3 x 1
  Vector3<S> angular_acceleration{};  ///< dw/dt [rad/s^2], 3 x 1
  Vector3<S> acceleration{};          ///< of the frame's origin, minus gravity [m/s^2], 3 x 1
};

/// The products of the components of an angular velocity, each of which occurs several times.
template <class S>
struct VelocityProducts {
  S xx, yy, zz, xy, xz, yz;

  constexpr explicit VelocityProducts(const Vector3<S>& w) noexcept
      : xx(w.x * w.x), yy(w.y * w.y), zz(w.z * w.z), xy(w.x * w.y), xz(w.x * w.z), yz(w.y * w.z) {}
};

/// The matrix U with U r the acceleration of a point at r relative to the origin:
/// U = [dw/dt]x + [w]x [w]x.
template <class S>
constexpr Matrix3<S> acceleration_gradient(const VelocityProducts<S>& w,
                                           const Vector3<S>& dw) noexcept {
  return {{{{-(w.yy + w.zz), w.xy - dw.z, w.xz + dw.y},
            {w.xy + dw.z, -(w.xx + w.zz), w.yz - dw.x},
            {w.xz - dw.y, w.yz + dw.x, -(w.xx + w.yy)}}}};
}

/// Force and moment of a body's motion. f = m a + U h and n = h x a + r with [r]x = U J - (U J)^T,
/// J the second moments of mass. In r.z the terms with dw.z are collected as (Jxx + Jyy) dw.z: one
/// multiplication, by a constant.
template <class S>
[[gnu::always_inline]] constexpr Wrench<S> wrench_for(const BodyMotion<S>& motion,
                                                      const VelocityProducts<S>& w,
                                                      const Matrix3<S>& u,
                                                      const MassMoments<S>& moments) noexcept {
  const Vector3<S>& h = moments.first;
  const Symmetric3<S>& j = moments.second;
  const auto& [ux, uy, uz] = u.rows;
  const Vector3<S> rotation_moment{
      j.yy * uz.y - j.zz * uy.z + j.yz * (w.zz - w.yy) + j.xy * uz.x - j.xz * uy.x,
      j.zz * ux.z - j.xx * uz.x + j.xz * (w.xx - w.zz) + j.yz * ux.y - j.xy * uz.y,
      (j.xx + j.yy) * motion.angular_acceleration.z + (j.xx - j.yy) * w.xy + j.xy * (w.yy - w.xx) +
          j.xz * uy.z - j.yz * ux.z};
  return {moments.mass * motion.acceleration + u * h,
          rotation_moment + cross(h, motion.acceleration)};
}

}  // namespace detail

/// The joint efforts of a motion: effort = M(q) a + h(q, v) with gravity in h. Velocities and
/// accelerations propagate from the base to the leaves, forces from the leaves to the base.
/// Source: [Luh, Walker, Paul 1980]; with the matrix U of [Balafoutis, Patel, Misra 1988]; in link
/// frames as [Khalil, Dombre 2002, section 9.5].
///
/// The rotors of the drives add their reflected inertia, n^2 J, to the diagonal of M. Rotors that
/// two joints share add to the element of both. A rotor has only its own spin, n v, about its axis.
/// The effects of its link's motion, gyroscopic moments included, are smaller by a factor n and
/// omitted [Spong 1987]; [Featherstone 2008, section 9.6]. The rotor's mass belongs to the link.
/// @param mechanism      the robot's bodies
/// @param configuration  at the joint positions
/// @param v              joint velocities [rad/s or m/s]
/// @param a              joint accelerations [rad/s^2 or m/s^2]
/// @return               joint efforts [N m or N]
/// Real-time: yes. O(N).
template <class S, int N, int B>
[[nodiscard]] constexpr JointArray<S, N> newton_euler(const Mechanism<N, B>& mechanism,
                                                      const Configuration<S, B>& configuration,
                                                      const JointArray<S, N>& v,
                                                      const JointArray<S, N>& a) noexcept {
  const JointArray<S, B> velocity = body_rates<S, N, B>(mechanism, v);
  const JointArray<S, B> acceleration = body_rates<S, N, B>(mechanism, a);
  detail::UnsetArray<detail::BodyMotion<S>, B> motions;
  detail::UnsetArray<Matrix3<S>, B> gradients;
  detail::UnsetArray<Wrench<S>, B> wrenches;
  for (int i = 0; i < B; ++i) {
    const Body& body = mechanism.bodies[i];
    const JointPlacement<S>& joint = configuration[i];
    Vector3<S> w{}, dw{}, dv = constant<S>(-mechanism.gravity);
    if (body.parent >= 0) {
      const int p = detail::parent_of(body, i);
      w = joint.from_parent(motions[p].angular_velocity);
      dw = joint.from_parent(motions[p].angular_acceleration);
      dv = motions[p].acceleration + gradients[p] * joint.translation;
    }
    dv = joint.from_parent(dv);
    if (body.prismatic) {
      const S coriolis = S(2.0) * velocity[i];
      dv = {dv.x + w.y * coriolis, dv.y - w.x * coriolis, dv.z + acceleration[i]};
    } else {
      dw = {dw.x + w.y * velocity[i], dw.y - w.x * velocity[i], dw.z + acceleration[i]};
      w.z = w.z + velocity[i];
    }
    const detail::BodyMotion<S> motion{w, dw, dv};
    const detail::VelocityProducts<S> products(w);
    const Matrix3<S> gradient = detail::acceleration_gradient(products, dw);
    motions.set(i, motion);
    gradients.set(i, gradient);
    wrenches.set(i, detail::wrench_for(motion, products, gradient, joint.moments));
  }

  JointArray<S, B> effort = detail::efforts_for<S, N, B>(mechanism, configuration, wrenches);
  for (int i = 0; i < B; ++i) {
    const Body& body = mechanism.bodies[i];
    if (body.reflected_inertia != 0) {
      effort[i] = effort[i] + configuration[i].reflected_inertia * acceleration[i];
    }
    if (body.sharing_body < 0) continue;
    const int other = body.sharing_body;
    effort[i] = effort[i] + S(body.shared_inertia) * acceleration[other];
    effort[other] = effort[other] + S(body.shared_inertia) * acceleration[i];
  }
  return joint_efforts<S, N, B>(mechanism, effort);
}

}  // namespace articula
