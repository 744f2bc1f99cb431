// SPDX-License-Identifier: Apache-2.0
/// @file A described robot with everything that makes equations of motion hard to simplify.
#pragma once

#include <articula/model/robot.hpp>

#include <array>

namespace support {

/// Axes that are oblique, parallel, antiparallel and prismatic, a branch, and a joint that follows.
struct Oddity {
  static constexpr articula::Symmetric3<double> inertia{0.02, 0.001, -0.002, 0.03, 0.003, 0.025};
  static constexpr articula::RobotDescription description{
      .name = "oddity",
      .gravity = {1, 2, -9},
      .links = std::to_array<articula::Link>({
          {.name = "base"},
          {.name = "a", .mass = 2, .center_of_mass = {0.1, 0.2, -0.1}, .inertia = inertia},
          {.name = "b", .mass = 1, .center_of_mass = {0, 0.1, 0.3}, .inertia = inertia},
          {.name = "c", .mass = 1.5, .center_of_mass = {0.2, 0, 0.1}, .inertia = inertia},
          {.name = "d", .mass = 0.5, .center_of_mass = {-0.1, 0.2, 0}, .inertia = inertia},
          {.name = "e", .mass = 0.7, .center_of_mass = {0, 0.3, 0.1}, .inertia = inertia},
          {.name = "f", .mass = 0.7, .center_of_mass = {0, 0.3, 0.1}, .inertia = inertia},
      }),
      .joints = std::to_array<articula::Joint>({
          {.name = "1",
           .type = articula::JointType::revolute,
           .parent = "base",
           .child = "a",
           .origin = {0.1, 0, 0.3},
           .orientation = {0.4, 1.0, -0.3},
           .axis = {1, 2, 2}},
          {.name = "2",
           .type = articula::JointType::continuous,
           .parent = "a",
           .child = "b",
           .origin = {0.4, 0.1, 0},
           .orientation = {0.2, 0, 0.5},
           .axis = {0, 1, 0}},
          {.name = "3",
           .type = articula::JointType::revolute,
           .parent = "b",
           .child = "c",
           .origin = {0.3, -0.1, 0.2},
           .axis = {0, -1, 0}},
          {.name = "4",
           .type = articula::JointType::prismatic,
           .parent = "c",
           .child = "d",
           .origin = {0, 0.1, 0.2},
           .axis = {0, 1, 0}},
          {.name = "5",
           .type = articula::JointType::revolute,
           .parent = "d",
           .child = "e",
           .origin = {0.1, 0, 0.1},
           .axis = {0, 1, 0}},
          {.name = "6",
           .type = articula::JointType::revolute,
           .parent = "b",
           .child = "f",
           .origin = {0, 0.2, 0},
           .orientation = {0, 0, 0.8},
           .axis = {1, 0, 1},
           .mimic = {.joint = "5", .multiplier = -0.5, .offset = 0.25}},
      })};
};

}  // namespace support
