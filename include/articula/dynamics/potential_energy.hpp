// SPDX-License-Identifier: Apache-2.0
/// @file The potential energy of a robot in gravity.
#pragma once

#include "articula/dynamics/engine/body_placements.hpp"
#include "articula/dynamics/engine/evaluate.hpp"

namespace articula {

/// The algorithm of potential_energy.
struct PotentialEnergy {
  static constexpr bool needs_own_frames = true;

  template <class S, int N, int B>
  [[nodiscard]] static constexpr S evaluate(const Mechanism<N, B>& mechanism,
                                            const Configuration<S, B>& configuration) noexcept {
    const auto placements = BodyPlacements::evaluate<S, N, B>(mechanism, configuration);
    const Vector3<S> upward = constant<S>(-mechanism.gravity);
    S energy = S(0.0);
    for (int i = 0; i < B; ++i) {
      const Inertia<double>& inertia = mechanism.bodies[i].inertia;
      const Vector3<S> first_moment = placements[i].rotation * constant<S>(inertia.first_moment) +
                                      S(inertia.mass) * placements[i].translation;
      energy = energy + dot(upward, first_moment);
    }
    return energy;
  }
};

/// The potential energy of the moving bodies in the robot's gravity, -sum of m g . c. It is zero
/// for masses at the origin of the base frame.
/// @param robot  a described robot or a model
/// @param q      joint positions [rad or m], N x 1
/// @return       energy [J]
/// Real-time: yes. O(N).
template <Robot R>
[[nodiscard]] double potential_energy(const R& robot,
                                      const JointVector<joint_count<R>>& q) noexcept {
  return detail::evaluate<PotentialEnergy>(robot, q);
}

}  // namespace articula
