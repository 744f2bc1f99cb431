// SPDX-License-Identifier: Apache-2.0
/// @file The concept of robots with dynamics, and the compiler error for other robots.
#pragma once

#include "articula/model/robot.hpp"

#include <type_traits>
#include <utility>

namespace articula {

/// True for a robot whose masses are not known: its description has `.kinematic = true`, or it is a
/// KinematicModel.
template <Robot R>
inline constexpr bool is_kinematic =
    std::remove_cvref_t<decltype(model_of(std::declval<R>()))>::kinematic;

/// A robot whose masses are known, so that it has dynamics.
template <class R>
concept DynamicRobot = Robot<R> && !is_kinematic<R>;

namespace detail {

/// Its instantiation is the compiler error where dynamics are needed of a robot without masses.
/// @tparam R     the robot
/// @tparam User  the algorithm or class that needs its dynamics
template <Robot R, class User>
struct RobotHasNoMasses {
  static_assert(!is_kinematic<R>,
                "articula: this robot is kinematic: it was described with .kinematic = true or "
                "loaded by load_kinematic_urdf, so its masses are not known and it has no "
                "dynamics. The first template argument of RobotHasNoMasses is the robot, the "
                "second is the algorithm or class that needs dynamics.");
  static constexpr bool found = true;
};

/// True. An algorithm or class that needs masses has `static_assert(detail::has_masses<R, User>)`.
template <Robot R, class User>
inline constexpr bool has_masses = RobotHasNoMasses<R, User>::found;

}  // namespace detail

}  // namespace articula
