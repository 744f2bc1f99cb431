// SPDX-License-Identifier: Apache-2.0
/// @file The clock of simulations.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"

namespace articula::ros2::rosgraph_msgs {

namespace msg {

/// The present time of nodes with use_sim_time.
struct Clock {
  builtin_interfaces::msg::Time clock{};

  static constexpr TypeName ros_type = "rosgraph_msgs/msg/Clock";
  static constexpr FieldNames<1> ros_fields{"clock"};
};

}  // namespace msg

}  // namespace articula::ros2::rosgraph_msgs
