// SPDX-License-Identifier: Apache-2.0
/// @file Where a robot starts in a simulation, as its URDF says.
#pragma once

#include "articula/model/robot.hpp"
#include "articula/urdf/description.hpp"

#include <algorithm>
#include <string>

namespace articula {

/// The positions at which a simulation starts: the `initial_value`s of <ros2_control>; of joints
/// without, 0 or the nearest position within the limits.
///
///     Simulator sim(arm, SimulatorOptions<6>{.initial_position = initial_positions(arm, urdf)});
///
/// @param robot        made of the description
/// @param description  what was read
/// @return             [rad or m], N x 1
/// Real-time: no (searches by name).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> initial_positions(const R& robot,
                                                            const UrdfDescription& description) {
  return joint_values(robot, [&](const JointProperties& joint) {
    const auto found = description.initial_values.find(std::string(joint.name.view()));
    const double zero = std::clamp(0.0, joint.limits.lower, joint.limits.upper);
    return found == description.initial_values.end() ? zero : found->second.position.value_or(zero);
  });
}

/// The velocities at which a simulation starts, likewise; of joints without, 0.
/// @return  [rad/s or m/s], N x 1
/// Real-time: no (searches by name).
template <Robot R>
[[nodiscard]] JointVector<joint_count<R>> initial_velocities(const R& robot,
                                                             const UrdfDescription& description) {
  return joint_values(robot, [&](const JointProperties& joint) {
    const auto found = description.initial_values.find(std::string(joint.name.view()));
    return found == description.initial_values.end() ? 0 : found->second.velocity.value_or(0);
  });
}

}  // namespace articula
