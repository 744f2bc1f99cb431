// SPDX-License-Identifier: Apache-2.0
/// @file Trajectories of joints.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"
#include "articula/ros2/messages/geometry_msgs.hpp"
#include "articula/ros2/messages/std_msgs.hpp"

namespace articula::ros2::trajectory_msgs {

namespace msg {

/// One point of a trajectory. Each sequence has an item per joint, or none.
template <class Layout>
struct JointTrajectoryPoint {
  Sequence<Layout, double> positions{};      ///< [rad] or [m]
  Sequence<Layout, double> velocities{};     ///< [rad/s] or [m/s]
  Sequence<Layout, double> accelerations{};  ///< [rad/s^2] or [m/s^2]
  Sequence<Layout, double> effort{};         ///< [N m] or [N]
  builtin_interfaces::msg::Duration time_from_start{};

  static constexpr TypeName ros_type = "trajectory_msgs/msg/JointTrajectoryPoint";
  static constexpr FieldNames<5> ros_fields{"positions", "velocities", "accelerations", "effort",
                                            "time_from_start"};
};

/// A trajectory of some joints.
template <class Layout>
struct JointTrajectory {
  std_msgs::msg::Header<Layout> header{};  ///< when it begins; zero: at once
  Sequence<Layout, Text<Layout>> joint_names{};
  Sequence<Layout, msg::JointTrajectoryPoint<Layout>> points{};

  static constexpr TypeName ros_type = "trajectory_msgs/msg/JointTrajectory";
  static constexpr FieldNames<3> ros_fields{"header", "joint_names", "points"};
};

/// One point of a trajectory of joints with several degrees of freedom.
template <class Layout>
struct MultiDOFJointTrajectoryPoint {
  Sequence<Layout, geometry_msgs::msg::Transform> transforms{};
  Sequence<Layout, geometry_msgs::msg::Twist> velocities{};
  Sequence<Layout, geometry_msgs::msg::Twist> accelerations{};
  builtin_interfaces::msg::Duration time_from_start{};

  static constexpr TypeName ros_type = "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint";
  static constexpr FieldNames<4> ros_fields{"transforms", "velocities", "accelerations",
                                            "time_from_start"};
};

/// A trajectory of joints with several degrees of freedom.
template <class Layout>
struct MultiDOFJointTrajectory {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, Text<Layout>> joint_names{};
  Sequence<Layout, msg::MultiDOFJointTrajectoryPoint<Layout>> points{};

  static constexpr TypeName ros_type = "trajectory_msgs/msg/MultiDOFJointTrajectory";
  static constexpr FieldNames<3> ros_fields{"header", "joint_names", "points"};
};

}  // namespace msg

}  // namespace articula::ros2::trajectory_msgs
