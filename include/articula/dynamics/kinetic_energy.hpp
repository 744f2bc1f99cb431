// SPDX-License-Identifier: Apache-2.0
/// @file The kinetic energy of a robot.
#pragma once

#include "articula/dynamics/engine/evaluate.hpp"

namespace articula {

/// The algorithm of kinetic_energy. It computes velocities from the base outwards, then the sum
/// over the bodies of m u.u/2 + u.(w x h) + w.I w/2. u is the velocity of the frame's origin.
struct KineticEnergy {
  template <class S, int N, int B>
  [[nodiscard]] static constexpr S evaluate(const Mechanism<N, B>& mechanism,
                                            const Configuration<S, B>& configuration,
                                            const JointArray<S, N>& v) noexcept {
    JointArray<Vector3<S>, B> angular, linear;
    const JointArray<S, B> velocity = body_rates<S, N, B>(mechanism, v);
    S energy = S(0.0);
    for (int i = 0; i < B; ++i) {
      const Body& body = mechanism.bodies[i];
      Vector3<S> w{}, u{};
      if (body.parent >= 0) {
        const int p = detail::parent_of(body, i);
        w = configuration[i].from_parent(angular[p]);
        u = configuration[i].from_parent(linear[p] +
                                         cross(angular[p], configuration[i].translation));
      }
      (body.prismatic ? u.z : w.z) = (body.prismatic ? u.z : w.z) + velocity[i];
      angular[i] = w;
      linear[i] = u;
      const auto& [mass, h, j] = configuration[i].moments;
      const Symmetric3<S> inertia{j.yy + j.zz, -j.xy, -j.xz, j.xx + j.zz, -j.yz, j.xx + j.yy};
      energy = energy + S(0.5) * (mass * dot(u, u) + dot(w, inertia * w)) + dot(u, cross(w, h));
      if (body.reflected_inertia != 0) {
        energy = energy + S(0.5 * body.reflected_inertia) * (velocity[i] * velocity[i]);
      }
      if (body.sharing_body >= 0) {
        energy = energy + S(body.shared_inertia) * (velocity[i] * velocity[body.sharing_body]);
      }
    }
    return energy;
  }
};

/// The kinetic energy of the moving bodies and of the drives' rotors, v^T M(q) v / 2.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @param v      joint velocities [rad/s or m/s], N x 1
/// @return       energy [J]
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] double kinetic_energy(const R& robot, const JointVector<joint_count<R>>& q,
                                    const JointVector<joint_count<R>>& v) noexcept {
  return detail::evaluate<KineticEnergy>(robot, q, v);
}

}  // namespace articula
