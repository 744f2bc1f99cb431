// SPDX-License-Identifier: Apache-2.0
/// @file The options of a controller that ROS sees as a gripper's.
#pragma once

#include "articula/core/refuse.hpp"

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace articula::ros2 {

/// When a gripper has reached a goal or is stalled. Names and values are those of the parameters of
/// ros2_controllers' gripper controllers.
struct GripperOptions {
  std::string joint{};                      ///< empty: the controller's only joint
  double goal_tolerance = 0.01;             ///< distance from the goal [m or rad]
  bool allow_stalling = false;              ///< a stalled gripper has succeeded
  double stall_velocity_threshold = 0.001;  ///< the joint moves above it [m/s or rad/s]
  double stall_timeout = 1;                 ///< time without motion after which it is stalled [s]

  friend bool operator==(const GripperOptions&, const GripperOptions&) = default;
};

/// Whether a type of controllers is a gripper's: it offers the action gripper_cmd.
/// Real-time: yes, likewise is_parallel_gripper.
[[nodiscard]] inline bool is_gripper(std::string_view type) noexcept {
  return type.ends_with("/GripperActionController");
}
/// Whether the action of a gripper's type is ParallelGripperCommand. Otherwise it is
/// GripperCommand.
[[nodiscard]] inline bool is_parallel_gripper(std::string_view type) noexcept {
  return type == "parallel_gripper_action_controller/GripperActionController";
}

/// Refuses options that make no sense.
/// @param controller  its name, for the message
/// @throws std::invalid_argument naming controller, option and value
/// Real-time: no (throws).
inline void validate(std::string_view controller, const GripperOptions& options) {
  for (const auto& [name, value] : std::initializer_list<std::pair<std::string_view, double>>{
           {"goal_tolerance", options.goal_tolerance},
           {"stall_velocity_threshold", options.stall_velocity_threshold},
           {"stall_timeout", options.stall_timeout}}) {
    if (value >= 0 && value <= 1e6) continue;
    articula::detail::refuse(
        {"ros2: ", name, " ", value, " of gripper '", controller, "' is not within 0 .. 1000000"});
  }
}

}  // namespace articula::ros2
