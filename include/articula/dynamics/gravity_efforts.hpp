// SPDX-License-Identifier: Apache-2.0
/// @file The algorithm behind gravity. It stands apart because the frames in which a robot's
/// programs calculate are chosen by it, see compiled.hpp.
#pragma once

#include "articula/dynamics/newton_euler.hpp"

namespace articula {

/// Newton-Euler for a robot at rest, where only weights are left.
struct Gravity {
  template <class S, int N, int B>
  [[nodiscard]] static constexpr JointArray<S, N> evaluate(
      const Mechanism<N, B>& mechanism, const Configuration<S, B>& configuration) noexcept {
    JointArray<Vector3<S>, B> upward;  // minus gravity, in each body's frame
    JointArray<Wrench<S>, B> wrenches;
    for (std::size_t i = 0; i < upward.size(); ++i) {
      const Body& body = mechanism.bodies[i];
      upward[i] = configuration[i].from_parent(body.parent < 0
                                                   ? constant<S>(-mechanism.gravity)
                                                   : upward[static_cast<std::size_t>(body.parent)]);
      const MassMoments<S>& moments = configuration[i].moments;
      wrenches[i] = {moments.mass * upward[i], cross(moments.first, upward[i])};
    }
    JointArray<S, B> effort;
    for (std::size_t i = upward.size(); i-- > 0;) {
      const Body& body = mechanism.bodies[i];
      effort[i] = body.prismatic ? wrenches[i].force.z : wrenches[i].moment.z;
      if (body.parent < 0) continue;
      Wrench<S>& parent = wrenches[static_cast<std::size_t>(body.parent)];
      const Vector3<S> force = configuration[i].to_parent(wrenches[i].force);
      parent.force = parent.force + force;
      parent.moment = parent.moment + configuration[i].to_parent(wrenches[i].moment) +
                      cross(configuration[i].translation, force);
    }
    return joint_efforts<S, N, B>(mechanism, effort);
  }
};

}  // namespace articula
