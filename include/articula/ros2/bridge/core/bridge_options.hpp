// SPDX-License-Identifier: Apache-2.0
/// @file The options of a Bridge.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/ros2/bridge/core/controller_options.hpp"
#include "articula/ros2/dds/fast_dds_options.hpp"
#include "articula/ros2/layout.hpp"

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>

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
  /// The type of controllers that clients see, if ControllerOptions::type is empty.
  std::string controller_type = "joint_trajectory_controller/JointTrajectoryController";
  /// Of the parameters of gains: gains.<joint>.<gain>. With an empty one they are <joint>.<gain>.
  std::string gain_prefix = "gains.";
  std::map<std::string, ControllerOptions> controllers{};  ///< by their names in the loop
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
  validate_gain_prefix(options.gain_prefix);
  const std::string& clock = options.clock_topic;
  if (!clock.empty() && (!options.use_sim_time || clock.size() < 2 || clock.front() != '/')) {
    articula::detail::refuse({"ros2: clock_topic '", clock, "' needs ",
                              options.use_sim_time ? "a full name, as /clock" : "use_sim_time"});
  }
  for (const auto& [name, controller] : options.controllers) validate(name, controller);
}

}  // namespace articula::ros2
