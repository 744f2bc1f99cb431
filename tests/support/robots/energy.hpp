// SPDX-License-Identifier: Apache-2.0
/// @file Where a simulated robot's energy comes from.
#pragma once

#include <articula/dynamics/kinetic_energy.hpp>
#include <articula/dynamics/potential_energy.hpp>
#include <articula/sim/simulator.hpp>

namespace support {

/// Kinetic and potential energy [J].
template <articula::Robot R>
[[nodiscard]] double energy(const articula::Simulator<R>& simulator) {
  const auto& state = simulator.true_state();
  return kinetic_energy(simulator.robot(), state.position, state.velocity) +
         potential_energy(simulator.robot(), state.position);
}

/// Simulates one period and returns the energy that came from nowhere: the increase beyond the work
/// of the drives, which is exact, as their efforts are constant [J]. Losses count as negative.
template <articula::Robot R>
[[nodiscard]] double unearned_energy(
    articula::Simulator<R>& simulator,
    const articula::JointVector<articula::joint_count<R>>& effort) {
  const double before = energy(simulator);
  const auto start = simulator.true_state().position;
  static_cast<void>(simulator.write({effort}));
  const auto& state = simulator.true_state();
  return energy(simulator) - before - state.effort.dot(state.position - start);
}

/// True if every joint is within its limits, to the last bit.
template <articula::Robot R>
[[nodiscard]] bool within_limits(const articula::Simulator<R>& simulator) {
  const auto& q = simulator.true_state().position;
  for (int j = 0; j < articula::joint_count<R>; ++j) {
    const auto& limits = model_of(simulator.robot()).joints[static_cast<std::size_t>(j)].limits;
    if (!(q[j] >= limits.lower && q[j] <= limits.upper)) return false;
  }
  return true;
}

}  // namespace support
