// SPDX-License-Identifier: Apache-2.0
/// @file Options and counters of a loop that is a robot behind topics.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/ros2/layout.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace articula::ros2 {

/// The options of a TopicRobot. Names and defaults of the topics are those of the plugin
/// topic_based_ros2_control.
struct TopicRobotOptions {
  std::string joint_states_topic = "/robot_joint_states";      ///< out: sensor_msgs/msg/JointState
  std::string joint_commands_topic = "/robot_joint_commands";  ///< in: likewise
  /// Time without a command after which joints that were given a velocity stop, and efforts become
  /// 0. The controls are released then, too [s].
  double command_lifetime = 1;
  bool publishes_clock = true;                      ///< the loop's time on /clock
  Distribution distribution = Distribution::jazzy;  ///< of the ROS programs in the domain
  std::string node{};                               ///< name of the node; empty: the robot's
  std::string name_space{};                         ///< of the node, as "/left"; empty: none
  /// Receives a line for commands that the robot refuses, at most one a second. It must not call
  /// the TopicRobot.
  std::function<void(const std::string&)> warn{};
};

/// Refuses options that make no sense.
/// @throws std::invalid_argument naming option and value
/// Real-time: no (throws).
inline void validate(const TopicRobotOptions& options) {
  if (!(options.command_lifetime > 0 && options.command_lifetime <= 1e6)) {
    articula::detail::refuse({"topic robot: command_lifetime ", options.command_lifetime,
                              " s is not within 0 .. 1000000 s"});
  }
  for (const std::string* topic : {&options.joint_states_topic, &options.joint_commands_topic}) {
    if (topic->size() < 2 || topic->front() != '/') {
      articula::detail::refuse(
          {"topic robot: topic '", *topic, "' is no full name, as /arm/joint_states"});
    }
  }
}

/// Counters of a TopicRobot since its construction.
struct TopicRobotStatistics {
  std::uint64_t accepted = 0;   ///< commands that the loop has done
  std::uint64_t foreign = 0;    ///< messages without any joint of the robot
  std::uint64_t malformed = 0;  ///< messages that were refused as a whole
  std::uint64_t refused = 0;    ///< commands that the loop does not take
  std::uint64_t expired = 0;    ///< stops because no command came in time
};

}  // namespace articula::ros2
