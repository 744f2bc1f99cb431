// SPDX-License-Identifier: Apache-2.0
/// @file The topics that show a robot: joint states, frames, description, clock.
#pragma once

#include "articula/ros2/bridge/core/bridge_core.hpp"
#include "articula/ros2/messages/control_msgs.hpp"
#include "articula/ros2/messages/rosgraph_msgs.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/messages/tf2_msgs.hpp"
#include "articula/ros2/node/periodic.hpp"
#include "articula/ros2/node/publisher.hpp"

#include <cstdint>
#include <optional>

namespace articula::ros2 {

/// Publishes joint_states and dynamic_joint_states as a joint_state_broadcaster; /tf, /tf_static
/// and robot_description as a robot_state_publisher; /clock if ROS has the loop's time.
/// Real-time: no (allocates).
class RobotTopics {
 public:
  /// @param core  outlives this
  explicit RobotTopics(BridgeCore& core);

  /// Publishes what is due.
  void update();

  [[nodiscard]] const Node& broadcaster() const noexcept { return broadcaster_; }
  [[nodiscard]] const Node& state_publisher() const noexcept { return state_publisher_; }

 private:
  void publish_joints();
  void publish_frames();

  BridgeCore& core_;
  Node broadcaster_;
  Node state_publisher_;
  Publisher<sensor_msgs::msg::JointState<Jazzy>> joint_states_;
  Publisher<control_msgs::msg::DynamicJointState<Jazzy>> dynamic_joint_states_;
  Publisher<tf2_msgs::msg::TFMessage<Jazzy>> tf_;
  Publisher<tf2_msgs::msg::TFMessage<Jazzy>> tf_static_;
  Publisher<std_msgs::msg::String<Jazzy>> description_;
  std::optional<Publisher<rosgraph_msgs::msg::Clock>> clock_{};
  Periodic states_due_;
  std::optional<std::uint64_t> published_cycle_{};
  sensor_msgs::msg::JointState<Jazzy> joints_{};
  control_msgs::msg::DynamicJointState<Jazzy> dynamic_{};
  tf2_msgs::msg::TFMessage<Jazzy> frames_{};
  bool static_published_ = false;
};

}  // namespace articula::ros2
