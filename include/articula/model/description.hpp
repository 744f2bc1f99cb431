// SPDX-License-Identifier: Apache-2.0
/// @file A robot's description: links, joints and gravity, known at compile time.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/joint.hpp"
#include "articula/model/link.hpp"

#include <array>
#include <cstddef>

namespace articula {

/// A robot's description as its author writes it: a tree of links and joints in any order, with
/// URDF's conventions.
///
///     struct Pendulum {
///       static constexpr auto description = articula::RobotDescription{
///           .name = "pendulum",
///           .gravity = {0, 0, -9.81},
///           .links = std::to_array<articula::Link>({{.name = "stand"}, {.name = "rod", ...}}),
///           .joints = std::to_array<articula::Joint>({{.name = "pivot", ...}})};
///     };
///
/// For a robot whose size is known at run time, use load_urdf.
/// @tparam Links   number of links
/// @tparam Joints  number of joints, the fixed ones included
template <std::size_t Links, std::size_t Joints>
struct RobotDescription {
  Name name{};
  /// Acceleration of free fall in the root link's frame [m/s^2], 3 x 1
  Vector3<double> gravity{0, 0, -9.81};
  std::array<Link, Links> links{};
  std::array<Joint, Joints> joints{};
  bool allow_unphysical = false;  ///< accept inertias that no real body has, see concerns_inertia
  /// Tolerance for right angles that are written with few digits, 0 .. 0.1, dimensionless, see
  /// canonical_form; 0 uses every angle as it is written
  double right_angle_tolerance = default_right_angle_tolerance;
  /// The masses are not known: those of the links are ignored, and functions that need dynamics do
  /// not compile with the robot, see DynamicRobot
  bool kinematic = false;
};

template <std::size_t Links, std::size_t Joints>
RobotDescription(Name, Vector3<double>, std::array<Link, Links>, std::array<Joint, Joints>,
                 bool = false, double = default_right_angle_tolerance, bool = false)
    -> RobotDescription<Links, Joints>;

// For descriptions without `.gravity`: compilers deduce from the order of initialisers alone.
template <std::size_t Links, std::size_t Joints>
RobotDescription(Name, std::array<Link, Links>, std::array<Joint, Joints>, bool = false,
                 double = default_right_angle_tolerance, bool = false)
    -> RobotDescription<Links, Joints>;

/// True for the types that RobotDescription makes.
template <class T>
inline constexpr bool is_robot_description = false;
template <std::size_t Links, std::size_t Joints>
inline constexpr bool is_robot_description<RobotDescription<Links, Joints>> = true;

}  // namespace articula
