// SPDX-License-Identifier: Apache-2.0
/// @file Time and duration in ROS messages.
#pragma once

#include "articula/ros2/fields.hpp"

#include <cstdint>

namespace articula::ros2::builtin_interfaces {

namespace msg {

/// A moment of a clock.
struct Time {
  std::int32_t sec = 0;       ///< [s]
  std::uint32_t nanosec = 0;  ///< fraction of a second, >= 0 [ns]

  static constexpr TypeName ros_type = "builtin_interfaces/msg/Time";
  static constexpr FieldNames<2> ros_fields{"sec", "nanosec"};
};

/// A time between two moments.
struct Duration {
  std::int32_t sec = 0;       ///< [s]
  std::uint32_t nanosec = 0;  ///< fraction of a second, >= 0, also if sec is negative [ns]

  static constexpr TypeName ros_type = "builtin_interfaces/msg/Duration";
  static constexpr FieldNames<2> ros_fields{"sec", "nanosec"};
};

}  // namespace msg

}  // namespace articula::ros2::builtin_interfaces
