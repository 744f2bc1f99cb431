// SPDX-License-Identifier: Apache-2.0
/// @file The Willow Garage PR2: a lifting torso, a head and two arms with grippers.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/robots/description_parts.hpp"
#include "articula/robots/pr2_arm.hpp"
#include "articula/sim/simulator.hpp"

#include <array>
#include <numbers>

namespace articula {

namespace detail {

/// The links besides the arms.
constexpr auto pr2_trunk_links() {
  return std::to_array<Link>({
      uniform_link("base_footprint", 1, 0.01),
      {.name = "base_link",
       .mass = 116,
       .center_of_mass = {-0.061, 0, 0.293},
       .inertia = {.xx = 5.652232699207,
                   .xy = -0.009719934438,
                   .xz = 1.293988226423,
                   .yy = 5.669473158652,
                   .yz = -0.007379583694,
                   .zz = 3.683196351726}},
      {.name = "torso_lift_link",
       .mass = 36.248046,
       .center_of_mass = {-0.1, 0, -0.0885},
       .inertia = {.xx = 2.771653750257,
                   .xy = 0.004284522609,
                   .xz = -0.160418504506,
                   .yy = 2.510019507959,
                   .yz = 0.029664468704,
                   .zz = 0.526432355569}},
      {.name = "head_pan_link",
       .mass = 1.611118,
       .center_of_mass = {-0.005717, 0.010312, -0.029649},
       .inertia = {.xx = 0.00482611007,
                   .xy = -0.000144683999,
                   .xz = 0.000110076136,
                   .yy = 0.005218991412,
                   .yz = -0.000314239509,
                   .zz = 0.008618784925}},
      {.name = "head_tilt_link",
       .mass = 1.749727,
       .center_of_mass = {0.041935, 0.003569, 0.028143},
       .inertia = {.xx = 0.010602303435,
                   .xy = -0.000408814235,
                   .xz = 0.00198303894,
                   .yy = 0.011874383747,
                   .yz = 0.000197908779,
                   .zz = 0.005516790626}},
      uniform_link("head_plate_frame", 0.01, 0.001),
      upright_link("sensor_mount_link", 0.05, 0, {.xx = 0.001, .yy = 0.001, .zz = 0.01}),
      upright_link("double_stereo_link", 0.1, 0, {.xx = 0.001, .yy = 0.001, .zz = 0.01}),
      uniform_link("narrow_stereo_link", 0.1, 0.01),
      uniform_link("narrow_stereo_gazebo_l_stereo_camera_frame", 0.01, 0.001),
      uniform_link("narrow_stereo_gazebo_r_stereo_camera_frame", 0.01, 0.001),
      uniform_link("wide_stereo_link", 0.1, 0.01),
      uniform_link("wide_stereo_gazebo_l_stereo_camera_frame", 0.01, 0.001),
      uniform_link("wide_stereo_gazebo_r_stereo_camera_frame", 0.01, 0.001),
      uniform_link("high_def_frame", 0.01, 0.001),
      uniform_link("high_def_optical_frame", 0.01, 0.001),
      {.name = "imu_link", .mass = 0.001, .inertia = {.xx = 0.0001, .yy = 1e-06, .zz = 0.0001}},
      {.name = "laser_tilt_mount_link",
       .mass = 0.05,
       .center_of_mass = {-0.03, 0, -0.03},
       .inertia = {.xx = 0.0001, .yy = 1e-05, .zz = 0.0001}},
      upright_link("laser_tilt_link", 0.001, 0, {.xx = 0.0001, .yy = 1e-06, .zz = 0.0001}),
  });
}

/// The joints besides those of the arms.
constexpr auto pr2_trunk_joints() {
  return std::to_array<Joint>({
      fixed_joint("base_footprint_joint", "base_footprint", "base_link", {0, 0, 0.051}),
      {.name = "torso_lift_joint",
       .type = JointType::prismatic,
       .parent = "base_link",
       .child = "torso_lift_link",
       .origin = {-0.05, 0, 0.739675},
       .axis = {0, 0, 1},
       .limits = {.lower = 0, .upper = 0.31, .velocity = 0.013, .effort = 10000},
       .damping = 20000},
      revolute_joint("head_pan_joint", "torso_lift_link", "head_pan_link", {-0.01707, 0, 0.38145},
                     {0, 0, 1}, symmetric_limits(3.007, 6, 2.645), 1),
      revolute_joint("head_tilt_joint", "head_pan_link", "head_tilt_link", {0.068, 0, 0}, {0, 1, 0},
                     {.lower = -0.471238, .upper = 1.39626, .velocity = 5, .effort = 15}, 1),
      fixed_joint("head_plate_frame_joint", "head_tilt_link", "head_plate_frame",
                  {0.0232, 0, 0.0645}),
      fixed_joint("sensor_mount_frame_joint", "head_plate_frame", "sensor_mount_link"),
      fixed_joint("double_stereo_frame_joint", "sensor_mount_link", "double_stereo_link",
                  {0, 0, 0.003}),
      fixed_joint("narrow_stereo_frame_joint", "double_stereo_link", "narrow_stereo_link",
                  {0, 0.06, 0.0305}),
      fixed_joint("narrow_stereo_gazebo_l_stereo_camera_frame_joint", "narrow_stereo_link",
                  "narrow_stereo_gazebo_l_stereo_camera_frame"),
      fixed_joint("narrow_stereo_gazebo_r_stereo_camera_frame_joint",
                  "narrow_stereo_gazebo_l_stereo_camera_frame",
                  "narrow_stereo_gazebo_r_stereo_camera_frame", {0, -0.09, 0}),
      fixed_joint("wide_stereo_frame_joint", "double_stereo_link", "wide_stereo_link",
                  {0, 0.03, 0.0305}),
      fixed_joint("wide_stereo_gazebo_l_stereo_camera_frame_joint", "wide_stereo_link",
                  "wide_stereo_gazebo_l_stereo_camera_frame"),
      fixed_joint("wide_stereo_gazebo_r_stereo_camera_frame_joint",
                  "wide_stereo_gazebo_l_stereo_camera_frame",
                  "wide_stereo_gazebo_r_stereo_camera_frame", {0, -0.09, 0}),
      fixed_joint("high_def_frame_joint", "sensor_mount_link", "high_def_frame",
                  {0, -0.109, 0.035}),
      {.name = "high_def_optical_frame_joint",
       .parent = "high_def_frame",
       .child = "high_def_optical_frame",
       .orientation = {-std::numbers::pi / 2, 0, -std::numbers::pi / 2}},
      {.name = "imu_joint",
       .parent = "torso_lift_link",
       .child = "imu_link",
       .origin = {-0.02977, -0.1497, 0.164},
       .orientation = {0, std::numbers::pi, 0}},
      revolute_joint("laser_tilt_mount_joint", "torso_lift_link", "laser_tilt_mount_link",
                     {0.09893, 0, 0.227}, {0, 1, 0},
                     {.lower = -0.7854, .upper = 1.48353, .velocity = 10, .effort = 0.65}, 0.008),
      fixed_joint("laser_tilt_joint", "laser_tilt_mount_link", "laser_tilt_link", {0, 0, 0.03}),
  });
}

}  // namespace detail

/// The Willow Garage PR2 on a fixed base. It has twenty joints: torso, head, laser, and eight in
/// each arm, the last of them for the gripper. Ten more mimic a gripper's joint. Figures: the
/// public robot description (pr2_description), with the links that move mass, the base and the
/// grippers' tool frames.
struct Pr2 {
  static constexpr RobotDescription description{
      .name = "pr2",
      .gravity = {0, 0, -9.81},
      .links = detail::joined(
          detail::pr2_trunk_links(),
          detail::pr2_arm_links({"l_", 1}, {.name = "l_upper_arm_link",
                                            .mass = 6.01769,
                                            .center_of_mass = {0.21405, 0.01658, -0.00057},
                                            .inertia = {.xx = 0.01530603856,
                                                        .xy = -0.00339324862,
                                                        .xz = 0.00060765455,
                                                        .yy = 0.07473694455,
                                                        .yz = -0.00019953729,
                                                        .zz = 0.07601594191}}),
          detail::pr2_arm_links({"r_", -1}, {.name = "r_upper_arm_link",
                                             .mass = 6.01769,
                                             .center_of_mass = {0.21398, -0.01621, -0.0002},
                                             .inertia = {.xx = 0.01537748957,
                                                         .xy = 0.00375711247,
                                                         .xz = -0.00070852914,
                                                         .yy = 0.0747367044,
                                                         .yz = -0.0001793645,
                                                         .zz = 0.07608763307}})),
      .joints = detail::joined(
          detail::pr2_trunk_joints(),
          detail::pr2_arm_joints({"l_", 1}, {.lower = -0.714601836603, .upper = 2.2853981634},
                                 {.lower = -0.8, .upper = 3.9}),
          detail::pr2_arm_joints({"r_", -1}, {.lower = -2.2853981634, .upper = 0.714601836603},
                                 {.lower = -3.9, .upper = 0.8})),
      .allow_unphysical = true};  // two camera mounts have flat inertias
};

/// The PR2 in simulation.
using Pr2Sim = Simulator<Pr2>;

}  // namespace articula
