// SPDX-License-Identifier: Apache-2.0
/// @file Small robots that several tests share. Those that are models can be altered at run time.
#pragma once

#include <articula/robots/q2d.hpp>

#include "robots/blueprint.hpp"

namespace support {

/// The Q2D on a base that leans, so that gravity matters: its axes stand 0.6 : 0.8 off the
/// vertical.
struct TiltedQ2d {
  static constexpr auto description = [] {
    auto tilted = articula::Q2d::description;
    tilted.name = "tilted_q2d";
    tilted.gravity = {9.8 * 0.6, 0, -9.8 * 0.8};
    return tilted;
  }();
  static constexpr auto pid_gains = articula::Q2d::pid_gains;
};

/// A described robot as a run-time model.
template <articula::DescribedRobot R>
[[nodiscard]] articula::Model<articula::joint_count<R>> model() {
  return blueprint_of(R::description).template model<articula::joint_count<R>>();
}

/// The Q2D without damping, friction and limits: a free rigid-body arm.
template <articula::DescribedRobot R = articula::Q2d>
[[nodiscard]] articula::Model<2> free_arm() {
  articula::Model<2> arm = model<R>();
  for (auto& joint : arm.joints) {
    joint.limits = {};
    joint.damping = 0;
  }
  return arm;
}

/// A body on one joint named "joint" that feels a mass of 2 kg (or 2 kg m^2): for the vertical axis
/// gravity acts along a prismatic joint and on no revolute one.
[[nodiscard]] inline articula::Model<1> single_joint(articula::JointType type,
                                                     const articula::Vector3<double>& axis = {1, 0,
                                                                                              0}) {
  return Blueprint{
      .name = "single_joint",
      .gravity = {0, 0, -9.8},
      .links = {{.name = "rail"},
                {.name = "body", .mass = 2, .inertia = {.xx = 2, .yy = 2, .zz = 2}}},
      .joints = {{.name = "joint", .type = type, .parent = "rail", .child = "body", .axis = axis}}}
      .model<1>();
}

/// A mass of 2 kg on a level rail.
[[nodiscard]] inline articula::Model<1> slider() {
  return single_joint(articula::JointType::prismatic);
}

}  // namespace support
