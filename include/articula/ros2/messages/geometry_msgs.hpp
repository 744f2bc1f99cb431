// SPDX-License-Identifier: Apache-2.0
/// @file Placements and velocities of frames.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/std_msgs.hpp"

namespace articula::ros2::geometry_msgs {

namespace msg {

/// A vector.
struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;

  static constexpr TypeName ros_type = "geometry_msgs/msg/Vector3";
  static constexpr FieldNames<3> ros_fields{"x", "y", "z"};
};

/// An orientation, of length 1.
struct Quaternion {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;

  static constexpr TypeName ros_type = "geometry_msgs/msg/Quaternion";
  static constexpr FieldNames<4> ros_fields{"x", "y", "z", "w"};
};

/// The placement of a frame.
struct Transform {
  msg::Vector3 translation{};  ///< [m]
  msg::Quaternion rotation{};

  static constexpr TypeName ros_type = "geometry_msgs/msg/Transform";
  static constexpr FieldNames<2> ros_fields{"translation", "rotation"};
};

/// The velocity of a frame.
struct Twist {
  msg::Vector3 linear{};   ///< [m/s]
  msg::Vector3 angular{};  ///< [rad/s]

  static constexpr TypeName ros_type = "geometry_msgs/msg/Twist";
  static constexpr FieldNames<2> ros_fields{"linear", "angular"};
};

/// The placement of a frame in another one, at a time.
template <class Layout>
struct TransformStamped {
  std_msgs::msg::Header<Layout> header{};  ///< of the other frame
  Text<Layout> child_frame_id{};
  msg::Transform transform{};

  static constexpr TypeName ros_type = "geometry_msgs/msg/TransformStamped";
  static constexpr FieldNames<3> ros_fields{"header", "child_frame_id", "transform"};
};

}  // namespace msg

}  // namespace articula::ros2::geometry_msgs
