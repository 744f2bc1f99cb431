// SPDX-License-Identifier: Apache-2.0
/// @file The messages that all actions have.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"
#include "articula/ros2/messages/service_msgs.hpp"
#include "articula/ros2/messages/unique_identifier_msgs.hpp"

#include <cstdint>

namespace articula::ros2::action_msgs {

namespace msg {

/// A goal, and when it was accepted.
struct GoalInfo {
  unique_identifier_msgs::msg::UUID goal_id{};
  builtin_interfaces::msg::Time stamp{};

  static constexpr TypeName ros_type = "action_msgs/msg/GoalInfo";
  static constexpr FieldNames<2> ros_fields{"goal_id", "stamp"};
};

/// What has become of a goal.
struct GoalStatus {
  msg::GoalInfo goal_info{};
  std::int8_t status = 0;

  static constexpr std::int8_t accepted = 1;
  static constexpr std::int8_t executing = 2;
  static constexpr std::int8_t canceling = 3;
  static constexpr std::int8_t succeeded = 4;
  static constexpr std::int8_t canceled = 5;
  static constexpr std::int8_t aborted = 6;
  static constexpr TypeName ros_type = "action_msgs/msg/GoalStatus";
  static constexpr FieldNames<2> ros_fields{"goal_info", "status"};
};

/// The goals of an action server.
template <class Layout>
struct GoalStatusArray {
  Sequence<Layout, msg::GoalStatus> status_list{};

  static constexpr TypeName ros_type = "action_msgs/msg/GoalStatusArray";
  static constexpr FieldNames<1> ros_fields{"status_list"};
};
}  // namespace msg

namespace srv {

/// Cancels a goal by its identifier, all goals up to a time, or all (both are zero).
template <class Layout>
struct CancelGoal {
  static constexpr TypeName ros_type = "action_msgs/srv/CancelGoal";
  static constexpr std::int8_t none = 0;
  static constexpr std::int8_t rejected = 1;
  static constexpr std::int8_t unknown_goal = 2;
  static constexpr std::int8_t goal_terminated = 3;

  struct Request {
    msg::GoalInfo goal_info{};

    static constexpr TypeName ros_type = "action_msgs/srv/CancelGoal_Request";
    static constexpr FieldNames<1> ros_fields{"goal_info"};
  };
  struct Response {
    std::int8_t return_code = 0;
    Sequence<Layout, msg::GoalInfo> goals_canceling{};

    static constexpr TypeName ros_type = "action_msgs/srv/CancelGoal_Response";
    static constexpr FieldNames<2> ros_fields{"return_code", "goals_canceling"};
  };
};

}  // namespace srv

}  // namespace articula::ros2::action_msgs

namespace articula::ros2 {

/// The service by which a goal is sent to an action server.
/// @tparam Action  such as control_msgs::action::FollowJointTrajectory<Jazzy>
template <class Action>
struct SendGoal {
  static constexpr TypeName ros_type = joined(Action::ros_type, "_SendGoal");

  struct Request {
    unique_identifier_msgs::msg::UUID goal_id{};
    typename Action::Goal goal{};

    static constexpr TypeName ros_type = joined(Action::ros_type, "_SendGoal_Request");
    static constexpr FieldNames<2> ros_fields{"goal_id", "goal"};
  };
  struct Response {
    bool accepted = false;
    builtin_interfaces::msg::Time stamp{};

    static constexpr TypeName ros_type = joined(Action::ros_type, "_SendGoal_Response");
    static constexpr FieldNames<2> ros_fields{"accepted", "stamp"};
  };
};

/// The service that answers when a goal has ended.
template <class Action>
struct GetResult {
  static constexpr TypeName ros_type = joined(Action::ros_type, "_GetResult");

  struct Request {
    unique_identifier_msgs::msg::UUID goal_id{};

    static constexpr TypeName ros_type = joined(Action::ros_type, "_GetResult_Request");
    static constexpr FieldNames<1> ros_fields{"goal_id"};
  };
  struct Response {
    std::int8_t status = 0;  ///< see action_msgs::msg::GoalStatus
    typename Action::Result result{};

    static constexpr TypeName ros_type = joined(Action::ros_type, "_GetResult_Response");
    static constexpr FieldNames<2> ros_fields{"status", "result"};
  };
};

/// What an action server publishes while it works on a goal.
template <class Action>
struct FeedbackMessage {
  unique_identifier_msgs::msg::UUID goal_id{};
  typename Action::Feedback feedback{};

  static constexpr TypeName ros_type = joined(Action::ros_type, "_FeedbackMessage");
  static constexpr FieldNames<2> ros_fields{"goal_id", "feedback"};
};

/// An action as a type, of which ROS publishes the hash. No bytes of it are ever sent.
template <class Action>
struct ActionType {
  typename Action::Goal goal{};
  typename Action::Result result{};
  typename Action::Feedback feedback{};
  ServiceType<SendGoal<Action>> send_goal_service{};
  ServiceType<GetResult<Action>> get_result_service{};
  FeedbackMessage<Action> feedback_message{};

  static constexpr TypeName ros_type = Action::ros_type;
  static constexpr FieldNames<6> ros_fields{
      "goal", "result", "feedback", "send_goal_service", "get_result_service", "feedback_message"};
};

}  // namespace articula::ros2
