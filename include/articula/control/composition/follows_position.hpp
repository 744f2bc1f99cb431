// SPDX-License-Identifier: Apache-2.0
/// @file Which joints a controller moves to the position of the reference.
#pragma once

#include "articula/control/composition/parts.hpp"
#include "articula/core/joint_array.hpp"

#include <cstddef>

namespace articula {

/// The joints that a controller moves to the reference's position. A controller or law that does
/// not use this position says so:
///
///     static constexpr bool follows_position = false;
///
/// One that is made of others and says nothing follows as its parts do; of a Switch, the active one
/// counts. Any other follows. A Remote of a supervised loop lets the reference of the other joints
/// go along with the measurement.
/// @tparam N  number of joints
/// Real-time: yes.
template <int N, class C>
[[nodiscard]] JointArray<bool, N> joints_following_position(const C& controller) noexcept {
  JointArray<bool, N> joints{};
  if constexpr (requires { C::follows_position; }) {
    joints.fill(C::follows_position);
  } else if constexpr (HasParts<const C>) {
    detail::for_each_part(controller, [&](const auto& part, std::size_t index) {
      if constexpr (requires { controller.is_active(index); }) {
        if (!controller.is_active(index)) return;
      }
      const JointArray<bool, N> own = joints_following_position<N>(part);
      const PartScope<N> scope = detail::scope_of_part<N>(controller, index);
      for (int j = 0; j < N; ++j) joints[j] = joints[j] || (own[j] && scope.joints[j] != 0);
    });
  } else {
    joints.fill(true);
  }
  return joints;
}

}  // namespace articula
