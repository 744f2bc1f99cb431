// SPDX-License-Identifier: Apache-2.0
/// @file The Quanser 2-DOF serial flexible-joint arm with its flexible joints locked.
#pragma once

#include "articula/control/laws/pid_gains.hpp"
#include "articula/model/robot.hpp"
#include "articula/sim/simulator.hpp"

#include <array>
#include <numbers>

namespace articula {

/// The Quanser 2-DOF serial flexible-joint arm (Q2D): two vertical axes, shoulder and elbow, each
/// driven through a joint with a spring that is locked here. Gravity has no effect on it unless it
/// is tilted. Figures: the course's robot description; examples/q2d/q2d.urdf has the same.
struct Q2d {
  static constexpr RobotDescription description{
      .name = "q2d",
      .gravity = {0, 0, -9.8},
      .links = std::to_array<Link>({
          {.name = "origin_link"},
          {.name = "base_link",
           .mass = 6.9621272394,
           .center_of_mass = {0.074571214, -0.00008502114, 0.0396000605},
           .inertia = {.xx = 0.12983348950453222,
                       .xy = 0.00004414079177225,
                       .xz = -0.03019200341025967,
                       .yy = 0.17857934382693791,
                       .yz = 0.00000393635720902,
                       .zz = 0.258121438746214}},
          {.name = "shoulder_active_link",
           .mass = 0.19730261508,
           .center_of_mass = {0.0252456823, -0.00000002723, 0.06470401873},
           .inertia = {.xx = 0.00038685518702305,
                       .xy = 0.00000000055222416,
                       .xz = -0.00000031340718614,
                       .yy = 0.0001024143891387,
                       .yz = -0.00000000015426019,
                       .zz = 0.00047879093657893}},
          {.name = "shoulder_passive_link",
           .mass = 1.26475817816,
           .center_of_mass = {0.16516344805, -0.00048428845, -0.00016382412},
           .inertia = {.xx = 0.00346199967740929,
                       .xy = -0.00010902049981923,
                       .xz = -0.00401182173261703,
                       .yy = 0.03314904030482527,
                       .yz = 0.00005087359051462,
                       .zz = 0.03113579694057124}},
          {.name = "elbow_active_link",
           .mass = 0.19712951877,
           .center_of_mass = {0.02548273493, -0.00000002263, 0.05254513577},
           .inertia = {.xx = 0.00038850510800265,
                       .xy = 0.00000000052121416,
                       .xz = 0.00000404728675587,
                       .yy = 0.00010146693248154,
                       .yz = 0.00000000002789435,
                       .zz = 0.00048091942023028}},
          {.name = "elbow_passive_link",
           .mass = 0.67529215765,
           .center_of_mass = {0.06204831581, 0.00000013809, 0.01489882531},
           .inertia = {.xx = 0.00132247071698947,
                       .xy = -0.00000000605403474,
                       .xz = -0.00090893541574333,
                       .yy = 0.0077400710225375,
                       .yz = 0.00000000624688369,
                       .zz = 0.00751638349361413}},
          {.name = "tool_link"},
      }),
      .joints = std::to_array<Joint>({
          {.name = "base_joint", .parent = "origin_link", .child = "base_link"},
          {.name = "shoulder_active_joint",
           .type = JointType::revolute,
           .parent = "base_link",
           .child = "shoulder_active_link",
           .origin = {0, 0, 0.1477},
           .axis = {0, 0, 1},
           .limits = {.lower = -std::numbers::pi / 2,
                      .upper = std::numbers::pi / 2,
                      .velocity = 2.27,
                      .effort = 27.94},
           .damping = 29.7914},
          {.name = "shoulder_passive_joint",
           .parent = "shoulder_active_link",
           .child = "shoulder_passive_link"},
          {.name = "elbow_active_joint",
           .type = JointType::revolute,
           .parent = "shoulder_passive_link",
           .child = "elbow_active_link",
           .origin = {0.343, 0, 0},
           .axis = {0, 0, 1},
           .limits = {.lower = -std::numbers::pi / 2,
                      .upper = std::numbers::pi / 2,
                      .velocity = 23.08,
                      .effort = 13.62},
           .damping = 2.6404},
          {.name = "elbow_passive_joint",
           .parent = "elbow_active_link",
           .child = "elbow_passive_link"},
          {.name = "end_joint",
           .parent = "elbow_passive_link",
           .child = "tool_link",
           .origin = {0.267, 0, 0}},
      })};

  /// The gains of the course's PID controllers, shoulder then elbow.
  static constexpr std::array<PidGains, 2> pid_gains{{
      {.proportional = 2310,
       .integral = 4640,
       .derivative = 0.299,
       .integral_clamp_min = -27.94,
       .integral_clamp_max = 27.94},
      {.proportional = 339,
       .integral = 851,
       .derivative = 0.351,
       .integral_clamp_min = -13.62,
       .integral_clamp_max = 13.62},
  }};
};

/// The arm in simulation.
using Q2dSim = Simulator<Q2d>;

}  // namespace articula
