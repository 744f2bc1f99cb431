// SPDX-License-Identifier: Apache-2.0
/// @file The health of components.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/std_msgs.hpp"

#include <cstddef>

namespace articula::ros2::diagnostic_msgs {

namespace msg {

/// One figure of a report.
template <class Layout>
struct KeyValue {
  Text<Layout> key{};
  Text<Layout> value{};

  static constexpr TypeName ros_type = "diagnostic_msgs/msg/KeyValue";
  static constexpr FieldNames<2> ros_fields{"key", "value"};
};

/// A report on one component.
template <class Layout>
struct DiagnosticStatus {
  std::byte level{};  ///< 0: good, 1: warning, 2: error, 3: no data
  Text<Layout> name{};
  Text<Layout> message{};
  Text<Layout> hardware_id{};
  Sequence<Layout, msg::KeyValue<Layout>> values{};

  static constexpr TypeName ros_type = "diagnostic_msgs/msg/DiagnosticStatus";
  static constexpr FieldNames<5> ros_fields{"level", "name", "message", "hardware_id", "values"};
};

/// Reports on components.
template <class Layout>
struct DiagnosticArray {
  std_msgs::msg::Header<Layout> header{};
  Sequence<Layout, msg::DiagnosticStatus<Layout>> status{};

  static constexpr TypeName ros_type = "diagnostic_msgs/msg/DiagnosticArray";
  static constexpr FieldNames<2> ros_fields{"header", "status"};
};

}  // namespace msg

}  // namespace articula::ros2::diagnostic_msgs
