// SPDX-License-Identifier: Apache-2.0
/// @file The placements of many frames.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/geometry_msgs.hpp"

namespace articula::ros2::tf2_msgs {

namespace msg {

/// Placements of frames.
template <class Layout>
struct TFMessage {
  Sequence<Layout, geometry_msgs::msg::TransformStamped<Layout>> transforms{};

  static constexpr TypeName ros_type = "tf2_msgs/msg/TFMessage";
  static constexpr FieldNames<1> ros_fields{"transforms"};
};

}  // namespace msg

}  // namespace articula::ros2::tf2_msgs
