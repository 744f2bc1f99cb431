// SPDX-License-Identifier: Apache-2.0
/// @file The options of a Bridge.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/ros2/bridge/core/gripper_options.hpp"
#include "articula/ros2/dds/fast_dds_options.hpp"
#include "articula/ros2/layout.hpp"

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::ros2 {

/// The options of a Bridge.
struct BridgeOptions {
  Distribution distribution = Distribution::jazzy;  ///< of the ROS tools in the domain
  FastDdsOptions dds{};                             ///< domain, interfaces and memory
  std::string name_space{};                         ///< of all nodes, as "/left"; empty: none
  /// Before the names of frames, as "left/": so two robots in a domain have frames of their own.
  std::string frame_prefix{};
  bool operates = true;  ///< ROS may move the robot
  /// Time that the controls stay with ROS after its last message or request, if no trajectory is
  /// being followed [s].
  double controls_time = 1;
  /// Of joint states and frames [Hz], up to the loop's own rate.
  double state_rate = 100;
  double controller_state_rate = 50;  ///< of the controllers' states [Hz]
  double feedback_rate = 20;          ///< of goals [Hz]
  double result_lifetime = 10;        ///< of a goal after its end [s]
  /// Stamps have the loop's time, which is published as /clock: for nodes with use_sim_time.
  bool use_sim_time = false;
  /// With use_sim_time: stamps have the time of this topic, as /clock of another simulator. It is
  /// then not published.
  std::string clock_topic{};
  /// The types that clients see. MoveIt and rqt choose by them what they offer.
  std::string controller_type = "joint_trajectory_controller/JointTrajectoryController";
  std::map<std::string, std::string> controller_types{};  ///< of single controllers, by name
  /// The joints of single controllers, by name. Otherwise those of its gains, or all.
  std::map<std::string, std::vector<std::string>> controller_joints{};
  /// Of controllers whose type is a gripper's, by name. They offer the action gripper_cmd.
  std::map<std::string, GripperOptions> grippers{};
  /// Of the parameters of gains: gains.<joint>.<gain>. With an empty one they are <joint>.<gain>.
  std::string gain_prefix = "gains.";
  /// What the numbers on <controller>/commands are: "position", "velocity" or "effort", by name of
  /// the controller. Otherwise positions, or efforts if the controller has no gains.
  std::map<std::string, std::string> command_quantities{};
};

/// Refuses options that make no sense.
/// @throws std::invalid_argument naming option and value
/// Real-time: no (throws).
inline void validate(const BridgeOptions& options) {
  const std::string& space = options.name_space;
  if (!space.empty() && (space.front() != '/' || (space.size() > 1 && space.back() == '/'))) {
    articula::detail::refuse(
        {"ros2: name_space '", space, "' does not begin with / or ends with it"});
  }
  for (const auto& [name, value] : std::initializer_list<std::pair<std::string_view, double>>{
           {"controls_time", options.controls_time},
           {"state_rate", options.state_rate},
           {"controller_state_rate", options.controller_state_rate},
           {"feedback_rate", options.feedback_rate},
           {"result_lifetime", options.result_lifetime}}) {
    if (!(value > 0 && value <= 1e6)) {
      articula::detail::refuse({"ros2: ", name, " ", value, " is not within 0 .. 1000000"});
    }
  }
  if (!options.gain_prefix.empty() && options.gain_prefix.back() != '.') {
    articula::detail::refuse(
        {"ros2: gain_prefix '", options.gain_prefix, "' does not end with a dot: add one"});
  }
  const std::string& clock = options.clock_topic;
  if (!clock.empty() && (!options.use_sim_time || clock.size() < 2 || clock.front() != '/')) {
    articula::detail::refuse({"ros2: clock_topic '", clock, "' needs ",
                              options.use_sim_time ? "a full name, as /clock" : "use_sim_time"});
  }
  for (const auto& [controller, gripper] : options.grippers) validate(controller, gripper);
  for (const auto& [controller, quantity] : options.command_quantities) {
    if (quantity == "position" || quantity == "velocity" || quantity == "effort") continue;
    articula::detail::refuse({"ros2: command_quantities of '", controller, "': '", quantity,
                              "' is not position, velocity or effort"});
  }
}

}  // namespace articula::ros2
