// SPDX-License-Identifier: Apache-2.0
/// @file The common parts of ROS messages.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"

#include <cstdint>

namespace articula::ros2::std_msgs {

namespace msg {

/// When and in which frame data hold.
template <class Layout>
struct Header {
  builtin_interfaces::msg::Time stamp{};
  Text<Layout> frame_id{};

  static constexpr TypeName ros_type = "std_msgs/msg/Header";
  static constexpr FieldNames<2> ros_fields{"stamp", "frame_id"};
};

/// A text.
template <class Layout>
struct String {
  Text<Layout> data{};

  static constexpr TypeName ros_type = "std_msgs/msg/String";
  static constexpr FieldNames<1> ros_fields{"data"};
};

/// A number.
struct Float64 {
  double data = 0;

  static constexpr TypeName ros_type = "std_msgs/msg/Float64";
  static constexpr FieldNames<1> ros_fields{"data"};
};

/// One dimension of an array.
template <class Layout>
struct MultiArrayDimension {
  Text<Layout> label{};
  std::uint32_t size = 0;  ///< number of items
  std::uint32_t stride =
      0;  ///< items from one index of this dimension to the next one, times its size

  static constexpr TypeName ros_type = "std_msgs/msg/MultiArrayDimension";
  static constexpr FieldNames<3> ros_fields{"label", "size", "stride"};
};

/// How the items of an array are ordered.
template <class Layout>
struct MultiArrayLayout {
  Sequence<Layout, msg::MultiArrayDimension<Layout>> dim{};
  std::uint32_t data_offset = 0;  ///< items before the first one

  static constexpr TypeName ros_type = "std_msgs/msg/MultiArrayLayout";
  static constexpr FieldNames<2> ros_fields{"dim", "data_offset"};
};

/// An array of numbers, as commands to controllers.
template <class Layout>
struct Float64MultiArray {
  msg::MultiArrayLayout<Layout> layout{};
  Sequence<Layout, double> data{};

  static constexpr TypeName ros_type = "std_msgs/msg/Float64MultiArray";
  static constexpr FieldNames<2> ros_fields{"layout", "data"};
};

}  // namespace msg

}  // namespace articula::ros2::std_msgs
