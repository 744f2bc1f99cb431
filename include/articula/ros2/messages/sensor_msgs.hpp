// SPDX-License-Identifier: Apache-2.0
/// @file Measured states of joints.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/std_msgs.hpp"

namespace articula::ros2::sensor_msgs {

namespace msg {

/// The states of joints. Each sequence has an item per name, or none.
template <class Layout>
struct JointState {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, Text<Layout>> name{};
  Sequence<Layout, double> position{};  ///< [rad] or [m]
  Sequence<Layout, double> velocity{};  ///< [rad/s] or [m/s]
  Sequence<Layout, double> effort{};    ///< [N m] or [N]

  static constexpr TypeName ros_type = "sensor_msgs/msg/JointState";
  static constexpr FieldNames<5> ros_fields{"header", "name", "position", "velocity", "effort"};
};

}  // namespace msg

}  // namespace articula::ros2::sensor_msgs
