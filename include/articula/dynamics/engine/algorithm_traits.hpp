// SPDX-License-Identifier: Apache-2.0
/// @file The needs of an algorithm of a robot: masses, the frames of its bodies, one link.
#pragma once

#include "articula/model/robot.hpp"

namespace articula::compiled {

/// True for algorithms whose result depends on the frames of the bodies or on the distribution of
/// inertia among them. Such an algorithm has a member `needs_own_frames` and runs on the mechanism
/// as described; the others run on its canonical form.
template <class Algorithm>
inline constexpr bool needs_own_frames = requires { requires Algorithm::needs_own_frames; };

/// True for algorithms of kinematics, which also run for robots without masses. Such an algorithm
/// has a member `needs_no_masses`.
template <class Algorithm>
inline constexpr bool needs_no_masses = requires { requires Algorithm::needs_no_masses; };

/// Rejects an algorithm of dynamics for a robot without masses, at compile time.
template <class Algorithm, Robot R>
consteval void check_masses() {
  if constexpr (!needs_no_masses<Algorithm>) {
    static_assert(articula::detail::has_masses<R, Algorithm>);
  }
}

/// An algorithm about one link, named at compile time. It takes the robot's model and the joint
/// positions: `evaluate<frames, S>(model, q)`.
template <class Algorithm>
concept LinkAlgorithm = requires { Algorithm::link; };

/// The mechanism of a robot on which an algorithm runs. Real-time: yes.
template <class Algorithm, Robot R>
[[nodiscard]] constexpr const auto& mechanism_for(const R& robot) noexcept {
  if constexpr (needs_own_frames<Algorithm>) {
    return model_of(robot).mechanism;
  } else {
    return model_of(robot).canonical;
  }
}

}  // namespace articula::compiled
