// SPDX-License-Identifier: Apache-2.0
/// @file States of controllers, and the actions by which robots are moved.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"
#include "articula/ros2/messages/sensor_msgs.hpp"
#include "articula/ros2/messages/std_msgs.hpp"
#include "articula/ros2/messages/trajectory_msgs.hpp"

#include <cstdint>

namespace articula::ros2::control_msgs {

namespace msg {

/// Values of a joint's interfaces.
template <class Layout>
struct InterfaceValue {
  Sequence<Layout, Text<Layout>> interface_names{};
  Sequence<Layout, double> values{};

  static constexpr TypeName ros_type = "control_msgs/msg/InterfaceValue";
  static constexpr FieldNames<2> ros_fields{"interface_names", "values"};
};

/// Values of groups of interfaces.
template <class Layout>
struct DynamicInterfaceGroupValues {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, Text<Layout>> interface_groups{};
  Sequence<Layout, msg::InterfaceValue<Layout>> interface_values{};

  static constexpr TypeName ros_type = "control_msgs/msg/DynamicInterfaceGroupValues";
  static constexpr FieldNames<3> ros_fields{"header", "interface_groups", "interface_values"};
};

/// Values of interfaces that are read and commanded. Not in Humble.
template <class Layout>
struct DynamicInterfaceValues {
  std_msgs::msg::Header<Layout> header{};
  msg::InterfaceValue<Layout> states{};
  msg::InterfaceValue<Layout> commands{};

  static constexpr TypeName ros_type = "control_msgs/msg/DynamicInterfaceValues";
  static constexpr FieldNames<3> ros_fields{"header", "states", "commands"};
};

/// Values of all interfaces of joints.
template <class Layout>
struct DynamicJointState {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, Text<Layout>> joint_names{};
  Sequence<Layout, msg::InterfaceValue<Layout>> interface_values{};

  static constexpr TypeName ros_type = "control_msgs/msg/DynamicJointState";
  static constexpr FieldNames<3> ros_fields{"header", "joint_names", "interface_values"};
};

/// A width of a gripper.
struct GripperCommand {
  double position = 0;    ///< [m] or [rad]
  double max_effort = 0;  ///< [N] or [N m]

  static constexpr TypeName ros_type = "control_msgs/msg/GripperCommand";
  static constexpr FieldNames<2> ros_fields{"position", "max_effort"};
};

/// How far a joint may be from its trajectory. 0: as configured, negative: no limit.
template <class Layout>
struct JointTolerance {
  Text<Layout> name{};
  double position = 0;      ///< [rad] or [m]
  double velocity = 0;      ///< [rad/s] or [m/s]
  double acceleration = 0;  ///< [rad/s^2] or [m/s^2]

  static constexpr TypeName ros_type = "control_msgs/msg/JointTolerance";
  static constexpr FieldNames<4> ros_fields{"name", "position", "velocity", "acceleration"};
};

/// How far a joint with several degrees of freedom may be from its trajectory.
template <class Layout>
struct JointComponentTolerance {
  Text<Layout> joint_name{};
  std::uint16_t component = 0;
  double position = 0;      ///< [rad] or [m]
  double velocity = 0;      ///< [rad/s] or [m/s]
  double acceleration = 0;  ///< [rad/s^2] or [m/s^2]

  static constexpr TypeName ros_type = "control_msgs/msg/JointComponentTolerance";
  static constexpr FieldNames<5> ros_fields{"joint_name", "component", "position", "velocity",
                                            "acceleration"};
};

/// What a follower of trajectories does.
template <class Layout>
struct JointTrajectoryControllerState {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, Text<Layout>> joint_names{};
  trajectory_msgs::msg::JointTrajectoryPoint<Layout> reference{};
  trajectory_msgs::msg::JointTrajectoryPoint<Layout> feedback{};
  trajectory_msgs::msg::JointTrajectoryPoint<Layout> error{};
  trajectory_msgs::msg::JointTrajectoryPoint<Layout> output{};
  Until<Layout, Distribution::humble, trajectory_msgs::msg::JointTrajectoryPoint<Layout>> desired{};
  Until<Layout, Distribution::humble, trajectory_msgs::msg::JointTrajectoryPoint<Layout>> actual{};
  Sequence<Layout, Text<Layout>> multi_dof_joint_names{};
  trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout> multi_dof_reference{};
  trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout> multi_dof_feedback{};
  trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout> multi_dof_error{};
  trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout> multi_dof_output{};
  Until<Layout, Distribution::humble, trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout>>
      multi_dof_desired{};
  Until<Layout, Distribution::humble, trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout>>
      multi_dof_actual{};
  Since<Layout, Distribution::jazzy, double> speed_scaling_factor{};

  static constexpr TypeName ros_type = "control_msgs/msg/JointTrajectoryControllerState";
  static constexpr FieldNames<16> ros_fields{"header",
                                             "joint_names",
                                             "reference",
                                             "feedback",
                                             "error",
                                             "output",
                                             "desired",
                                             "actual",
                                             "multi_dof_joint_names",
                                             "multi_dof_reference",
                                             "multi_dof_feedback",
                                             "multi_dof_error",
                                             "multi_dof_output",
                                             "multi_dof_desired",
                                             "multi_dof_actual",
                                             "speed_scaling_factor"};
};

/// The terms of a PID controller.
template <class Layout>
struct PidState {
  std_msgs::msg::Header<Layout> header{};
  builtin_interfaces::msg::Duration timestep{};
  double error = 0;
  double error_dot = 0;
  Until<Layout, Distribution::jazzy, double> p_error{};
  Until<Layout, Distribution::jazzy, double> i_error{};
  Until<Layout, Distribution::jazzy, double> d_error{};
  Until<Layout, Distribution::jazzy, double> p_term{};  ///< the proportional gain
  double i_term = 0;  ///< the integral gain; in Rolling the integral's part of the output
  Until<Layout, Distribution::jazzy, double> d_term{};  ///< the derivative gain
  Until<Layout, Distribution::jazzy, double> i_max{};
  Until<Layout, Distribution::jazzy, double> i_min{};
  Since<Layout, Distribution::rolling, double> p_gain{};
  Since<Layout, Distribution::rolling, double> i_gain{};
  Since<Layout, Distribution::rolling, double> d_gain{};
  double output = 0;

  static constexpr TypeName ros_type = "control_msgs/msg/PidState";
  static constexpr FieldNames<16> ros_fields{
      "header", "timestep", "error", "error_dot", "p_error", "i_error", "d_error", "p_term",
      "i_term", "d_term",   "i_max", "i_min",     "p_gain",  "i_gain",  "d_gain",  "output"};
};

/// How fast trajectories are followed. Not in Humble.
struct SpeedScalingFactor {
  double factor = 0;

  static constexpr TypeName ros_type = "control_msgs/msg/SpeedScalingFactor";
  static constexpr FieldNames<1> ros_fields{"factor"};
};
}  // namespace msg

namespace srv {

/// Asks for the point of a trajectory at a time.
template <class Layout>
struct QueryTrajectoryState {
  static constexpr TypeName ros_type = "control_msgs/srv/QueryTrajectoryState";

  struct Request {
    builtin_interfaces::msg::Time time{};

    static constexpr TypeName ros_type = "control_msgs/srv/QueryTrajectoryState_Request";
    static constexpr FieldNames<1> ros_fields{"time"};
  };
  struct Response {
    bool success = false;
    Text<Layout> message{};
    Sequence<Layout, Text<Layout>> name{};
    Sequence<Layout, double> position{};
    Sequence<Layout, double> velocity{};
    Sequence<Layout, double> acceleration{};

    static constexpr TypeName ros_type = "control_msgs/srv/QueryTrajectoryState_Response";
    static constexpr FieldNames<6> ros_fields{"success",  "message",  "name",
                                              "position", "velocity", "acceleration"};
  };
};
}  // namespace srv

namespace action {

/// Follows a trajectory within tolerances.
template <class Layout>
struct FollowJointTrajectory {
  static constexpr TypeName ros_type = "control_msgs/action/FollowJointTrajectory";
  static constexpr std::int32_t successful = 0;
  static constexpr std::int32_t invalid_goal = -1;
  static constexpr std::int32_t invalid_joints = -2;
  static constexpr std::int32_t old_header_timestamp = -3;
  static constexpr std::int32_t path_tolerance_violated = -4;
  static constexpr std::int32_t goal_tolerance_violated = -5;

  struct Goal {
    trajectory_msgs::msg::JointTrajectory<Layout> trajectory{};
    trajectory_msgs::msg::MultiDOFJointTrajectory<Layout> multi_dof_trajectory{};
    Sequence<Layout, msg::JointTolerance<Layout>> path_tolerance{};
    Sequence<Layout, msg::JointComponentTolerance<Layout>> component_path_tolerance{};
    Sequence<Layout, msg::JointTolerance<Layout>> goal_tolerance{};
    Sequence<Layout, msg::JointComponentTolerance<Layout>> component_goal_tolerance{};
    builtin_interfaces::msg::Duration goal_time_tolerance{};

    static constexpr TypeName ros_type = "control_msgs/action/FollowJointTrajectory_Goal";
    static constexpr FieldNames<7> ros_fields{"trajectory",         "multi_dof_trajectory",
                                              "path_tolerance",     "component_path_tolerance",
                                              "goal_tolerance",     "component_goal_tolerance",
                                              "goal_time_tolerance"};
  };
  struct Result {
    std::int32_t error_code = 0;
    Text<Layout> error_string{};

    static constexpr TypeName ros_type = "control_msgs/action/FollowJointTrajectory_Result";
    static constexpr FieldNames<2> ros_fields{"error_code", "error_string"};
  };
  struct Feedback {
    std_msgs::msg::Header<Layout> header{};
    Sequence<Layout, Text<Layout>> joint_names{};
    trajectory_msgs::msg::JointTrajectoryPoint<Layout> desired{};
    trajectory_msgs::msg::JointTrajectoryPoint<Layout> actual{};
    trajectory_msgs::msg::JointTrajectoryPoint<Layout> error{};
    Since<Layout, Distribution::rolling, std::int32_t> index{};
    Sequence<Layout, Text<Layout>> multi_dof_joint_names{};
    trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout> multi_dof_desired{};
    trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout> multi_dof_actual{};
    trajectory_msgs::msg::MultiDOFJointTrajectoryPoint<Layout> multi_dof_error{};
    Since<Layout, Distribution::rolling, std::int32_t> multi_dof_index{};

    static constexpr TypeName ros_type = "control_msgs/action/FollowJointTrajectory_Feedback";
    static constexpr FieldNames<11> ros_fields{"header",
                                               "joint_names",
                                               "desired",
                                               "actual",
                                               "error",
                                               "index",
                                               "multi_dof_joint_names",
                                               "multi_dof_desired",
                                               "multi_dof_actual",
                                               "multi_dof_error",
                                               "multi_dof_index"};
  };
};

/// Opens or closes a gripper.
template <class Layout>
struct GripperCommand {
  static constexpr TypeName ros_type = "control_msgs/action/GripperCommand";

  struct Goal {
    msg::GripperCommand command{};

    static constexpr TypeName ros_type = "control_msgs/action/GripperCommand_Goal";
    static constexpr FieldNames<1> ros_fields{"command"};
  };
  struct Result {
    double position = 0;  ///< [m] or [rad]
    double effort = 0;    ///< [N] or [N m]
    bool stalled = false;
    bool reached_goal = false;

    static constexpr TypeName ros_type = "control_msgs/action/GripperCommand_Result";
    static constexpr FieldNames<4> ros_fields{"position", "effort", "stalled", "reached_goal"};
  };
  struct Feedback {
    double position = 0;  ///< [m] or [rad]
    double effort = 0;    ///< [N] or [N m]
    bool stalled = false;
    bool reached_goal = false;

    static constexpr TypeName ros_type = "control_msgs/action/GripperCommand_Feedback";
    static constexpr FieldNames<4> ros_fields{"position", "effort", "stalled", "reached_goal"};
  };
};

/// Opens or closes a gripper by names of joints.
template <class Layout>
struct ParallelGripperCommand {
  static constexpr TypeName ros_type = "control_msgs/action/ParallelGripperCommand";

  struct Goal {
    sensor_msgs::msg::JointState<Layout> command{};

    static constexpr TypeName ros_type = "control_msgs/action/ParallelGripperCommand_Goal";
    static constexpr FieldNames<1> ros_fields{"command"};
  };
  struct Result {
    sensor_msgs::msg::JointState<Layout> state{};
    bool stalled = false;
    bool reached_goal = false;

    static constexpr TypeName ros_type = "control_msgs/action/ParallelGripperCommand_Result";
    static constexpr FieldNames<3> ros_fields{"state", "stalled", "reached_goal"};
  };
  struct Feedback {
    sensor_msgs::msg::JointState<Layout> state{};

    static constexpr TypeName ros_type = "control_msgs/action/ParallelGripperCommand_Feedback";
    static constexpr FieldNames<1> ros_fields{"state"};
  };
};

}  // namespace action

}  // namespace articula::ros2::control_msgs
