// SPDX-License-Identifier: Apache-2.0
/// @file Names, fallbacks and transfer of a set of controllers.
#pragma once

#include "articula/core/joint_vector.hpp"
#include "articula/core/name.hpp"

#include <optional>
#include <vector>

namespace articula {

/// What takes over from a controller that fails: the first of these that does not fail as well.
struct Fallback {
  Name controller{};
  std::vector<Name> instead{};
};

/// How a set of controllers is named, begins and falls back.
/// @tparam N  number of joints
template <int N>
struct SwitchOptions {
  /// Of all controllers, in their order; if empty, each has its own `name`, or "controller_1" and
  /// so on by its position. Of two that would be called "pid" the second is "pid_2".
  std::vector<Name> names{};
  std::vector<Fallback> fallbacks{};
  /// The controller that is active at first; an empty name: none. If not given, the first.
  std::optional<Name> active{};
  /// How fast the difference to the command before a switch decays [unit of the command per s], N x
  /// 1. If not set: for efforts and velocities the drive's limit in 0.1 s. For positions it is a
  /// quarter of the velocity limit.
  std::optional<JointVector<N>> slew{};
  double damping_time = 0.1;  ///< of the standby while none is active, see Standby [s]
};

}  // namespace articula
