// SPDX-License-Identifier: Apache-2.0
/// @file The concept of a source of references.
#pragma once

#include "articula/core/joint_reference.hpp"

#include <concepts>

namespace articula {

/// A source of references for N joints as a function of time:
///
///     loop.reference() = generator.sample(loop.next_time());
///
/// `sample(time)` returns the reference at a time [s]. The user chooses the clock. The function is
/// noexcept and must not allocate, lock or call the system, since it runs in the control loop.
/// Signals, profiles and trajectories have no memory and can be sampled in any order. A
/// TrajectoryFollower moves on with each sample.
/// @tparam G  the generator
template <class G, int N>
concept ReferenceGenerator = requires(G generator, double time) {
  { generator.sample(time) } noexcept -> std::same_as<JointReference<N>>;
};

}  // namespace articula
