// SPDX-License-Identifier: Apache-2.0
/// @file The states of components that are configured and activated.
#pragma once

#include "articula/ros2/fields.hpp"

#include <cstdint>

namespace articula::ros2::lifecycle_msgs {

namespace msg {

/// A state by number and name.
template <class Layout>
struct State {
  std::uint8_t id = 0;
  Text<Layout> label{};  ///< "unconfigured", "inactive", "active" or "finalized"

  static constexpr std::uint8_t unconfigured = 1;
  static constexpr std::uint8_t inactive = 2;
  static constexpr std::uint8_t active = 3;
  static constexpr std::uint8_t finalized = 4;
  static constexpr TypeName ros_type = "lifecycle_msgs/msg/State";
  static constexpr FieldNames<2> ros_fields{"id", "label"};
};

}  // namespace msg

}  // namespace articula::ros2::lifecycle_msgs
