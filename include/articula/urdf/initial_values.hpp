// SPDX-License-Identifier: Apache-2.0
/// @file Initial positions and velocities of a simulation from URDF.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/urdf/description.hpp"

#include <algorithm>
#include <string>

namespace articula {

/// The positions at the start of a simulation. Each joint has its `initial_value` in
/// <ros2_control>, or without one 0, or the position within the limits that is nearest to 0.
///
///     Simulator sim(arm, SimulatorOptions<6>{.initial_position = initial_positions(arm, urdf)});
///
/// @param robot        made from the description
/// @param description  from read_urdf
/// @return             [rad or m], N x 1
/// Real-time: no (searches by name).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> initial_positions(const R& robot,
                                                            const UrdfDescription& description) {
  return joint_values(robot, [&](const JointProperties& joint) {
    const auto found = description->initial_values.find(std::string(joint.name));
    const double zero = std::clamp(0.0, joint.limits.lower, joint.limits.upper);
    return found == description->initial_values.end() ? zero
                                                      : found->second.position.value_or(zero);
  });
}

/// The velocities at the start of a simulation: each joint's `initial_value`, or 0.
/// @return  [rad/s or m/s], N x 1
/// Real-time: no (searches by name).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> initial_velocities(const R& robot,
                                                             const UrdfDescription& description) {
  return joint_values(robot, [&](const JointProperties& joint) {
    const auto found = description->initial_values.find(std::string(joint.name));
    return found == description->initial_values.end() ? 0 : found->second.velocity.value_or(0);
  });
}

}  // namespace articula
