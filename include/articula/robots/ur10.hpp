// SPDX-License-Identifier: Apache-2.0
/// @file The Universal Robots UR10, an arm with six revolute joints.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/description_parts.hpp"
#include "articula/sim/simulator.hpp"

#include <array>
#include <numbers>

namespace articula {

namespace detail {

constexpr std::array<Joint, 7> ur10_joints() {
  const auto arm_joint = [](const Name& name, const Name& parent, const Name& child,
                            const Vector3<double>& origin, double pitch,
                            const Vector3<double>& axis, const JointLimits& limits) {
    Joint joint = revolute_joint(name, parent, child, origin, axis, limits, 0);
    joint.orientation.y = pitch;
    return joint;
  };
  const double turn = 2 * std::numbers::pi, right_angle = std::numbers::pi / 2;
  const Vector3<double> y{0, 1, 0}, z{0, 0, 1};
  Joint tool = fixed_joint("tool0_joint", "wrist_3_link", "tool0", {0, 0.0922, 0});
  tool.orientation.x = -right_angle;
  return {{
      arm_joint("shoulder_pan_joint", "base_link", "shoulder_link", {0, 0, 0.1273}, 0, z,
                symmetric_limits(turn, 2.16, 330)),
      arm_joint("shoulder_lift_joint", "shoulder_link", "upper_arm_link", {0, 0.220941, 0},
                right_angle, y, symmetric_limits(turn, 2.16, 330)),
      arm_joint("elbow_joint", "upper_arm_link", "forearm_link", {0, -0.1719, 0.612}, 0, y,
                symmetric_limits(turn / 2, 3.15, 150)),
      arm_joint("wrist_1_joint", "forearm_link", "wrist_1_link", {0, 0, 0.5723}, right_angle, y,
                symmetric_limits(turn, 3.2, 54)),
      arm_joint("wrist_2_joint", "wrist_1_link", "wrist_2_link", {0, 0.1149, 0}, 0, z,
                symmetric_limits(turn, 3.2, 54)),
      arm_joint("wrist_3_joint", "wrist_2_link", "wrist_3_link", {0, 0, 0.1157}, 0, y,
                symmetric_limits(turn, 3.2, 54)),
      tool,
  }};
}

}  // namespace detail

/// The Universal Robots UR10: six revolute joints, the second to the fourth with parallel axes.
/// Figures: the public robot description of ROS-Industrial (ur_description).
struct Ur10 {
  static constexpr RobotDescription description{
      .name = "ur10",
      .gravity = {0, 0, -9.81},
      .links = std::to_array<Link>({
          detail::upright_link("base_link", 4.0, 0,
                               {.xx = 0.0061063308908, .yy = 0.0061063308908, .zz = 0.01125}),
          detail::upright_link("shoulder_link", 7.778, 0,
                               {.xx = 0.0314743125769, .yy = 0.0314743125769, .zz = 0.021875625}),
          detail::upright_link("upper_arm_link", 12.93, 0.306,
                               {.xx = 0.421753803798, .yy = 0.421753803798, .zz = 0.036365625}),
          detail::upright_link("forearm_link", 3.87, 0.28615,
                               {.xx = 0.111069694097, .yy = 0.111069694097, .zz = 0.010884375}),
          detail::upright_link("wrist_1_link", 1.96, 0,
                               {.xx = 0.0051082479567, .yy = 0.0051082479567, .zz = 0.0055125}),
          detail::upright_link("wrist_2_link", 1.96, 0,
                               {.xx = 0.0051082479567, .yy = 0.0051082479567, .zz = 0.0055125}),
          detail::upright_link(
              "wrist_3_link", 0.202, 0,
              {.xx = 0.000526462289415, .yy = 0.000526462289415, .zz = 0.000568125}),
          {.name = "tool0"},
      }),
      .joints = detail::ur10_joints()};
};

/// The arm in simulation.
using Ur10Sim = Simulator<Ur10>;

}  // namespace articula
