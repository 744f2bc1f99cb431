// SPDX-License-Identifier: Apache-2.0
/// @file Forces and moments, and their propagation to the base.
#pragma once

#include "articula/dynamics/engine/configuration.hpp"
#include "articula/dynamics/engine/unset_array.hpp"
#include "articula/model/mechanism.hpp"

namespace articula {

/// A force and a moment about the origin of a body's frame.
template <class S>
struct Wrench {
  Vector3<S> force{};   ///< [N], 3 x 1
  Vector3<S> moment{};  ///< [N m], 3 x 1
};

namespace detail {

/// The joint efforts of the wrenches on the bodies. Each body's parent bears its own wrench and
/// those of all bodies that it carries. Source: [Luh, Walker, Paul 1980].
/// @param wrenches  of each body alone, in its frame; overwritten
/// @return          the components along the joints' axes [N m or N]
template <class S, int N, int B>
[[nodiscard]] constexpr JointArray<S, B> efforts_for(const Mechanism<N, B>& mechanism,
                                                     const Configuration<S, B>& configuration,
                                                     UnsetArray<Wrench<S>, B>& wrenches) noexcept {
  static_assert(B > 0, "articula: a mechanism without bodies moves nothing");
  JointArray<S, B> effort;
  // Most parents are the preceding body: its wrench stays in registers, because the next step needs
  // it at once.
  Wrench<S> wrench = wrenches[B - 1];
  for (int i = B; i-- > 0;) {
    const Body& body = mechanism.bodies[i];
    effort[i] = body.prismatic ? wrench.force.z : wrench.moment.z;
    if (i == 0) break;
    Wrench<S> next = wrenches[i - 1];
    if (body.parent >= 0) {
      const int p = parent_of(body, i);
      const Vector3<S> force = configuration[i].to_parent(wrench.force);
      Wrench<S> parent = p + 1 == i ? next : wrenches[p];
      parent.force = parent.force + force;
      parent.moment = parent.moment + cross(configuration[i].translation, force) +
                      configuration[i].to_parent(wrench.moment);
      if (p + 1 == i) {
        next = parent;
      } else {
        wrenches[p] = parent;
      }
    }
    wrench = next;
  }
  return effort;
}

}  // namespace detail

}  // namespace articula
