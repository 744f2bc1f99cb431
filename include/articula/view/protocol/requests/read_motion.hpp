// SPDX-License-Identifier: Apache-2.0
/// @file References, trajectories and signals, read from JSON.
#pragma once

#include "articula/view/protocol/requests/requests.hpp"

#include <array>
#include <vector>

namespace articula::view {

/// Of trajectory_msgs/JointTrajectory.
inline constexpr std::array trajectory_members{Member{"header", Kind::anything},
                                               Member{"joint_names", Kind::texts, true},
                                               Member{"points", Kind::objects, true}};
/// Of the service /play_signals.
inline constexpr std::array play_signals_members{Member{"signals", Kind::objects, true},
                                                 Member{"duration", Kind::number, true}};
/// Of the topic /reference: those of sensor_msgs/JointState.
inline constexpr std::array published_reference_members{
    Member{"header", Kind::anything}, Member{"name", Kind::texts, true},
    Member{"position", Kind::numbers}, Member{"velocity", Kind::numbers},
    Member{"effort", Kind::numbers}};

/// A member of an object, {"joint": value}; nothing if the object lacks it.
[[nodiscard]] std::vector<remote::JointValue> joint_values(const Json& object, const char* member);

/// Each of these reads an object whose members were checked, and checks what is within them.
[[nodiscard]] Asked read_trajectory(const Json& message);
[[nodiscard]] Asked read_signals(const Json& call);
[[nodiscard]] Asked read_published_reference(const Json& message);

}  // namespace articula::view
