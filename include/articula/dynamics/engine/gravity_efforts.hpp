// SPDX-License-Identifier: Apache-2.0
/// @file The algorithm of gravity. It is a header of its own because it decides in which frames a
/// robot's programs compute, see compiled.hpp.
#pragma once

#include "articula/dynamics/engine/unset_array.hpp"
#include "articula/dynamics/engine/wrench.hpp"

namespace articula {

/// The Newton-Euler algorithm for a robot at rest: weights only.
struct Gravity {
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(
      const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration) noexcept {
    detail::UnsetArray<Vector3<S>, B> upward;  // minus gravity, in each body's frame
    detail::UnsetArray<Wrench<S>, B> wrenches;
    for (int i = 0; i < B; ++i) {
      const Body& body = mechanism.bodies[i];
      const Vector3<S> own = configuration[i].from_parent(
          body.parent < 0 ? constant<S>(-mechanism.gravity) : upward[detail::parent_of(body, i)]);
      const MassMoments<S>& moments = configuration[i].moments;
      upward.set(i, own);
      wrenches.set(i, {moments.mass * own, cross(moments.first, own)});
    }
    return joint_efforts<S, N, B>(mechanism,
                                  detail::efforts_for<S, N, B>(mechanism, configuration, wrenches));
  }
};

}  // namespace articula
