// SPDX-License-Identifier: Apache-2.0
/// @file The options of one controller in ROS.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/ros2/bridge/core/gripper_options.hpp"
#include "articula/ros2/bridge/core/trajectory_constraints.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::ros2 {

/// One controller of a loop as ROS shall see it.
struct ControllerOptions {
  /// The type that clients see, from which they choose what they offer. Empty:
  /// BridgeOptions::controller_type.
  std::string type{};
  std::vector<std::string> joints{};  ///< that it commands; empty: those of its gains, or all
  /// What the numbers on <controller>/commands are: "position", "velocity" or "effort". Empty:
  /// positions, or efforts if the controller has no gains.
  std::string command_quantity{};
  std::optional<std::string> gain_prefix{};  ///< none: BridgeOptions::gain_prefix
  /// Of trajectories, with an entry for each of its joints or none. Without constraints: the
  /// tolerances of the Remote.
  std::optional<TrajectoryConstraints> constraints{};
  GripperOptions gripper{};  ///< if the type is a gripper's; it offers the action gripper_cmd
};

/// Refuses a prefix of gains that is no part of a name.
/// @throws std::invalid_argument with the prefix
/// Real-time: no (throws).
inline void validate_gain_prefix(std::string_view prefix) {
  if (prefix.empty() || prefix.back() == '.') return;
  articula::detail::refuse({"ros2: gain_prefix '", prefix, "' does not end with a dot: add one"});
}

/// Refuses options that make no sense.
/// @param controller  its name, for the message
/// @throws std::invalid_argument naming controller, option and value
/// Real-time: no (throws).
inline void validate(std::string_view controller, const ControllerOptions& options) {
  validate(controller, options.gripper);
  validate_gain_prefix(options.gain_prefix.value_or(""));
  if (options.constraints) validate(controller, *options.constraints);
  const std::string& quantity = options.command_quantity;
  if (quantity.empty() || quantity == "position" || quantity == "velocity" || quantity == "effort")
    return;
  articula::detail::refuse({"ros2: command_quantity of '", controller, "': '", quantity,
                            "' is not position, velocity or effort"});
}

}  // namespace articula::ros2
