// SPDX-License-Identifier: Apache-2.0
/// @file Options and counters of a robot behind topics.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/ros2/layout.hpp"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace articula::ros2 {

/// The options of a TopicHardware. Names and defaults of the topics are those of the plugin
/// topic_based_ros2_control.
struct TopicHardwareOptions {
  std::string joint_states_topic = "/robot_joint_states";      ///< in: sensor_msgs/msg/JointState
  std::string joint_commands_topic = "/robot_joint_commands";  ///< out: likewise
  /// The positions that come wrap from 2 pi to -2 pi, as those of Isaac Sim do: whole turns are
  /// counted. For robots whose joints all revolve.
  bool sum_wrapped_joint_states = false;
  double stale_after = 0.05;      ///< age from which a joint's figures are not used [s]
  double silent_after = 0.5;      ///< age from which a joint is silent, which is a fault [s]
  double set_up_time = 5;         ///< longest wait for a state of each joint at activation [s]
  double command_deadline = 0.1;  ///< time without `write` after which a stop is sent [s]
  /// in: rosgraph_msgs/msg/Clock, as /clock, of a simulator: nothing is then older than by its
  /// time. Empty: the times above are those of this host alone.
  std::string clock_topic{};
  Distribution distribution = Distribution::jazzy;  ///< of the ROS programs in the domain
  std::string node{};  ///< name of the node; empty: topic_based_ros2_control_ and the robot's
};

/// Refuses options that make no sense.
/// @throws std::invalid_argument naming option and value
/// Real-time: no (throws).
inline void validate(const TopicHardwareOptions& options) {
  for (const auto& [name, value] : std::initializer_list<std::pair<std::string_view, double>>{
           {"stale_after", options.stale_after},
           {"silent_after", options.silent_after},
           {"command_deadline", options.command_deadline}}) {
    if (!(value > 0 && value <= 1e6)) {
      articula::detail::refuse(
          {"topic hardware: ", name, " ", value, " s is not within 0 .. 1000000 s"});
    }
  }
  if (!(options.set_up_time >= 0 && options.set_up_time <= 1e6)) {
    articula::detail::refuse(
        {"topic hardware: set_up_time ", options.set_up_time, " s is not within 0 .. 1000000 s"});
  }
  if (options.silent_after < options.stale_after) {
    articula::detail::refuse({"topic hardware: silent_after ", options.silent_after,
                              " s is less than stale_after ", options.stale_after, " s"});
  }
  for (const auto& [name, topic] : {std::pair<std::string_view, std::string_view>{
                                        "joint_states_topic", options.joint_states_topic},
                                    {"joint_commands_topic", options.joint_commands_topic},
                                    {"clock_topic", options.clock_topic}}) {
    if (name == "clock_topic" && topic.empty()) continue;
    if (topic.size() < 2 || topic.front() != '/') {
      articula::detail::refuse(
          {"topic hardware: ", name, " '", topic, "' is no full name, as /arm/joint_states"});
    }
  }
}

/// Counters of a TopicHardware since its construction.
struct TopicStatistics {
  std::uint64_t accepted = 0;          ///< messages with states of joints of the robot
  std::uint64_t foreign = 0;           ///< messages without any joint of the robot
  std::uint64_t malformed = 0;         ///< messages that were refused as a whole
  std::uint64_t sent = 0;              ///< commands, stops included
  std::uint64_t missed_deadlines = 0;  ///< stops because no command was written in time
  std::uint64_t clock_jumps = 0;       ///< steps of the simulator's clock that did not count
};

}  // namespace articula::ros2
