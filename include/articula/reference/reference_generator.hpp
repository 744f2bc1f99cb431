// SPDX-License-Identifier: Apache-2.0
/// @file What a generator of references is.
#pragma once

#include "articula/core/joint_reference.hpp"

#include <concepts>

namespace articula {

/// A source of references for N joints: what they shall do at a time.
///
///     loop.reference() = generator.sample(loop.next_time());
///
/// - `sample(time)` is the reference at a time [s], on whatever clock the user keeps.
///
/// It is noexcept and must not allocate, lock or call the system: it runs in the control loop.
/// Generators without memory (signals, profiles, trajectories) can be sampled in any order; a
/// TrajectoryFollower moves on with each sample.
/// @tparam G  the generator
/// @tparam N  number of joints
template <class G, int N>
concept ReferenceGenerator = requires(G generator, double time) {
  { generator.sample(time) } noexcept -> std::same_as<JointReference<N>>;
};

}  // namespace articula
