// SPDX-License-Identifier: Apache-2.0
/// @file Identifiers in ROS messages.
#pragma once

#include "articula/ros2/fields.hpp"

#include <array>
#include <cstdint>

namespace articula::ros2::unique_identifier_msgs {

namespace msg {

/// An identifier that no other thing has.
struct UUID {
  std::array<std::uint8_t, 16> uuid{};

  static constexpr TypeName ros_type = "unique_identifier_msgs/msg/UUID";
  static constexpr FieldNames<1> ros_fields{"uuid"};
};

}  // namespace msg

}  // namespace articula::ros2::unique_identifier_msgs
