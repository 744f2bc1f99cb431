// SPDX-License-Identifier: Apache-2.0
/// @file Loads a robot's PID gains from a file. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/load_controller.hpp"
#include "articula/config/read/robot_joints.hpp"
#include "articula/core/joint_array.hpp"
#include "articula/core/name.hpp"

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace articula {

/// The joints whose gains a file must have.
enum class GainsOf : unsigned char {
  all_joints,   ///< all joints of the robot
  some_joints,  ///< the joints that the controller lists, such as an arm without its gripper
};

/// A controller's parameters, and the gains of a robot with N joints.
template <int N>
struct PidConfig : ControllerConfig {
  JointPidGains<N> gains{};   ///< in the order of the robot's joints; 0 if the file has none
  std::vector<Name> group{};  ///< joints that have gains in the file, for Groups and OnJoints
  /// save_i_term, for ControlToolboxPidLaw, in the order of the robot's joints
  JointArray<bool, N> keeps_integral{};
};

/// Arranges gains in the order of a robot's joints, and checks that the file fits the robot.
/// @param config  from load_controller
/// @param whose   joints whose gains must be there
/// @throws FileError if the robot lacks a joint of the file, or a joint of it has no gains
/// @throws FileError if the chain leaves a joint out, or the file's gravity is not the robot's
/// Real-time: no (allocates, throws).
template <Robot R>
[[nodiscard]] PidConfig<joint_count<R>> pid_gains(const R& robot, ControllerConfig config,
                                                  GainsOf whose = GainsOf::all_joints) {
  PidConfig<joint_count<R>> result;
  const auto joints = detail::arranged_joints(config, robot);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const ConfiguredJoint* joint = joints[j];
    if (joint == nullptr) {
      if (whose == GainsOf::some_joints && !config.joints.empty()) continue;
      detail::refuse_missing(config, robot, j, "gains");
    }
    if (!joint->gains) {
      throw FileError(joint->place, "joint '" + detail::shown(joint->name) + "' has no gains",
                      "gains, such as " + detail::shown(joint->name) + ": {p: ...}");
    }
    result.gains[j] = *joint->gains;
    result.keeps_integral[j] = joint->keeps_integral;
    result.group.emplace_back(joint->name);
    const bool is_continuous = model_of(robot).joints[j].type == JointType::continuous;
    if (joint->angle_wraparound && *joint->angle_wraparound != is_continuous) {
      config.notes.push_back(joint->angle_wraparound_place.text() +
                             "not used: continuous joints take the short way round, others do not");
    }
  }
  detail::check_chain(config, robot);
  detail::check_gravity(config, robot);
  static_cast<ControllerConfig&>(result) = std::move(config);
  return result;
}

/// Loads a robot's PID gains from a file of ROS, for example from the Q2D's course:
///
///     const PidConfig<2> config = load_pid_gains(Q2d(), "pid_plus_gravity.yaml");
///     Loop<Q2dSim, PidPlusGravity> loop(PidPlusGravity<Q2d>(config.gains));
///     run(loop, RealtimeOptions{.thread = {.priority = config.priority.value_or(99)}});
///
/// A controller of some joints, such as those of an arm without its gripper:
///
///     const auto arm =
///         load_pid_gains(GripperArm(), "controllers.yaml", "arm", GainsOf::some_joints);
///     Groups<R, Pid<R>, Bypass<R>> parts({{{"arm", arm.group}, {"gripper", ...}}}, arm.gains,
///                                        ...);
///
/// Layouts, keys and their meaning: docs/configuration.md.
/// @param source, name, signs  see load_controller; the name may be empty if the file has one
///                             controller with gains
/// @param whose                joints whose gains must be there
/// @throws FileError with file, line, key and what was expected, see load_controller and pid_gains
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] PidConfig<joint_count<R>> load_pid_gains(const R& robot, const ConfigSource& source,
                                                       std::string_view name = {},
                                                       GainsOf whose = GainsOf::all_joints,
                                                       GainSigns signs = GainSigns::not_negative) {
  const detail::RobotJoints joints = detail::joints_of(robot);
  const auto relevant = [&](const detail::ConfigSection& section) {
    return detail::has_gains(section) || detail::is_joint(section, joints);
  };
  return pid_gains(
      robot,
      detail::load_controller(source, {name, "controller with gains", relevant}, &joints, signs),
      whose);
}

}  // namespace articula
