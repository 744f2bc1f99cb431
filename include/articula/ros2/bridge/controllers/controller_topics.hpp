// SPDX-License-Identifier: Apache-2.0
/// @file The topics of a controller: references in, its state out.
#pragma once

#include "articula/ros2/bridge/controllers/trajectory_messages.hpp"
#include "articula/ros2/bridge/core/bridge_core.hpp"
#include "articula/ros2/messages/std_msgs.hpp"
#include "articula/ros2/node/periodic.hpp"
#include "articula/ros2/node/publisher.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace articula::ros2 {

/// The topics of a controller:
///
/// - in: ~/commands, a number for each joint; ~/<joint>/command, one for a joint; ~/reference, a
///   point for all joints; ~/joint_trajectory. They are taken while the controller is active.
///   ~/speed_scaling_input, except in Humble;
/// - out: ~/controller_state, as joint_trajectory_controller publishes it, in Humble also ~/state;
/// - the service ~/query_state, which gives the reference at a time that has passed.
///
/// A reference with a velocity holds for BridgeOptions::controls_time. If no other one comes, the
/// joints stop. Positions and efforts stay. Real-time: no (allocates).
class ControllerTopics {
 public:
  /// @param core        outlives this
  /// @param node        the controller's, likewise
  /// @param controller  likewise
  ControllerTopics(BridgeCore& core, const Node& node, const BridgedController& controller);

  /// Publishes the state if it is due, and ends references that have become too old.
  void update();

 private:
  using State = control_msgs::msg::JointTrajectoryControllerState<Jazzy>;
  using HumbleState = control_msgs::msg::JointTrajectoryControllerState<Humble>;

  void take(const std_msgs::msg::Float64MultiArray<Jazzy>& message);
  void take(const std::string& joint, const std_msgs::msg::Float64& message);
  void take(const TrajectoryPointMessage& message);
  void take(const TrajectoryMessage& message);
  void take(const control_msgs::msg::SpeedScalingFactor& message);
  void set(std::vector<remote::JointValue> values);
  void set(const remote::SetReference& reference);
  void stop_old_motions();
  void ask(const remote::Request& request);
  void refuse(const std::string& reason);
  [[nodiscard]] bool is_active(const char* topic);
  [[nodiscard]] control_msgs::srv::QueryTrajectoryState<Jazzy>::Response query(
      const builtin_interfaces::msg::Time& time) const;

  BridgeCore& core_;
  const BridgedController& controller_;
  std::optional<Publisher<State>> state_{};
  std::optional<Publisher<HumbleState>> humble_state_{};
  std::optional<Publisher<HumbleState>> humble_old_state_{};  ///< the name before controller_state
  Periodic state_due_;
  std::optional<std::uint64_t> published_cycle_{};
  /// By joint of the controller: when it got a reference with a velocity.
  std::vector<std::optional<std::chrono::nanoseconds>> moving_since_;
};

}  // namespace articula::ros2
