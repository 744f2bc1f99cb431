// SPDX-License-Identifier: Apache-2.0
/// @file Which robots have dynamics, and how the compiler refuses them for the others.
#pragma once

#include "articula/model/robot.hpp"

#include <type_traits>
#include <utility>

namespace articula {

/// True for a robot whose masses are not known: a RobotDescription says `.kinematic = true`, or it
/// is a KinematicModel.
template <Robot R>
inline constexpr bool is_kinematic =
    std::remove_cvref_t<decltype(model_of(std::declval<R>()))>::kinematic;

/// A robot whose masses are known, so that it has dynamics.
template <class R>
concept DynamicRobot = Robot<R> && !is_kinematic<R>;

namespace detail {

/// Its instantiation is the error message where dynamics are asked of a robot that has none.
/// @tparam R      the robot
/// @tparam Asked  what was asked of it: an algorithm, or a class that needs one
template <Robot R, class Asked>
struct RobotHasNoMasses {
  static_assert(!is_kinematic<R>,
                "articula: this robot is kinematic: it was described with .kinematic = true or "
                "loaded by load_kinematic_urdf, so its masses are not known and it has no "
                "dynamics. The first template argument of RobotHasNoMasses is the robot, the "
                "second is what was asked of it.");
  static constexpr bool found = true;
};

/// True; what needs a robot's masses says `static_assert(detail::has_masses<R, Asked>)`.
template <Robot R, class Asked>
inline constexpr bool has_masses = RobotHasNoMasses<R, Asked>::found;

}  // namespace detail

}  // namespace articula
