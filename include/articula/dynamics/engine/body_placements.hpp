// SPDX-License-Identifier: Apache-2.0
/// @file The placements of a mechanism's bodies in the base frame.
#pragma once

#include "articula/dynamics/engine/configuration.hpp"

namespace articula {

/// The placement of every body in the base frame: X_0i = X_0p X_pi, from the base outwards.
struct BodyPlacements {
  static constexpr bool needs_own_frames = true;
  static constexpr bool needs_no_masses = true;

  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<Placement<S>, B> evaluate(
      const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration) noexcept {
    JointArray<Placement<S>, B> placements;
    for (int i = 0; i < B; ++i) {
      const Placement<S> in_parent{configuration[i].matrix(), configuration[i].translation};
      const Body& body = mechanism.bodies[i];
      placements[i] =
          body.parent < 0 ? in_parent : placements[detail::parent_of(body, i)] * in_parent;
    }
    return placements;
  }
};

}  // namespace articula
