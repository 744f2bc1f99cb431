// SPDX-License-Identifier: Apache-2.0
/// @file Reads a robot's PID gains from a file. Needs the CMake target articula::config (yaml-cpp).
#pragma once

#include "articula/config/arrange_joints.hpp"
#include "articula/config/load_controller.hpp"

#include <cstddef>
#include <string_view>
#include <utility>

namespace articula {

/// A controller's parameters, with the gains of a robot of N joints.
template <int N>
struct PidConfig : ControllerConfig {
  JointPidGains<N> gains{};  ///< in the order of the robot's joints
};

/// Puts gains in the order of a robot's joints, and makes sure that the file means this robot.
/// @throws ConfigError if the robot lacks a joint of the file, a joint of it has no gains, the
///         chain leaves a joint out, or the file's gravity is not the robot's
/// Real-time: no (allocates, throws).
template <Robot R>
[[nodiscard]] PidConfig<joint_count<R>> pid_gains(ControllerConfig config, const R& robot) {
  PidConfig<joint_count<R>> result;
  const auto joints = detail::arranged_joints(config, robot);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j] == nullptr || !joints[j]->gains) {
      detail::refuse_missing(config, robot, j, "gains");
    }
    result.gains[j] = *joints[j]->gains;
  }
  detail::check_chain(config, robot);
  detail::check_gravity(config, robot);
  static_cast<ControllerConfig&>(result) = std::move(config);
  return result;
}

/// Reads a robot's PID gains from a file, as pid_plus_gravity.yaml of the Q2D's course has them:
///
///     const PidConfig<2> config = load_pid_gains(Q2d(), "pid_plus_gravity.yaml");
///     Loop<Q2dSim, PidPlusGravity> loop(PidPlusGravity<Q2d>(config.gains));
///     run(loop, RealtimeOptions{.thread = {.priority = config.priority.value_or(99)}});
///
/// Layouts, keys and their meaning: docs/configuration.md.
/// @param robot   whose joints they are
/// @param source  a file, or a ConfigSource::text
/// @param name    of the controller, of a namespace, or the type of the controllers that are meant;
///                need not be given where there is but one with gains
/// @throws ConfigError with file, line, key and what was expected, see load_controller and pid_gains
/// Real-time: no (reads a file, allocates, throws).
template <Robot R>
[[nodiscard]] PidConfig<joint_count<R>> load_pid_gains(const R& robot, const ConfigSource& source,
                                                       std::string_view name = {}) {
  return pid_gains(
      detail::load_controller(source, name, detail::has_gains, "controller with gains"), robot);
}

}  // namespace articula
