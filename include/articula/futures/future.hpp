// SPDX-License-Identifier: Apache-2.0
/// @file A simulated future, and where it begins.
#pragma once

#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"
#include "articula/loop/command_history.hpp"
#include "articula/sim/simulation_end.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace articula {

/// One simulated future of N joints.
template <int N>
struct Future {
  std::vector<JointVector<N>> positions{};  ///< at the times of FutureOptions::samples [rad or m]
  SimulationEnd end = SimulationEnd::stable;
};

/// Where futures begin.
/// @tparam Command  of the controller
template <class Command>
struct FutureStart {
  JointState<Command::joint_count> state{};
  JointReference<Command::joint_count> reference{};  ///< held for the whole horizon
  Command command{};                                 ///< the last one
  /// Followed in place of `reference`, one in each cycle; the last one is held. Empty: none.
  std::vector<JointReference<Command::joint_count>> references{};
  /// What the controller knows of its last commands. Empty: that the last one carries the load.
  std::optional<CommandHistory<Command>> history{};

  /// The reference of a cycle of the future, from 0. Real-time: yes.
  [[nodiscard]] const JointReference<Command::joint_count>& reference_at(int cycle) const noexcept {
    if (references.empty()) return reference;
    return references[std::min(static_cast<std::size_t>(cycle), references.size() - 1)];
  }
};

}  // namespace articula
