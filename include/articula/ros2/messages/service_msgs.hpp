// SPDX-License-Identifier: Apache-2.0
/// @file The messages that all services have.
#pragma once

#include "articula/ros2/fields.hpp"
#include "articula/ros2/messages/builtin_interfaces.hpp"

#include <array>
#include <cstdint>

namespace articula::ros2::service_msgs {

namespace msg {

/// When a request or response was sent or received.
struct ServiceEventInfo {
  std::uint8_t event_type = 0;  ///< 0: request sent, 1: received, 2: response sent, 3: received
  builtin_interfaces::msg::Time stamp{};
  std::array<std::uint8_t, 16> client_gid{};
  std::int64_t sequence_number = 0;

  static constexpr TypeName ros_type = "service_msgs/msg/ServiceEventInfo";
  static constexpr FieldNames<4> ros_fields{"event_type", "stamp", "client_gid", "sequence_number"};
};

}  // namespace msg

}  // namespace articula::ros2::service_msgs

namespace articula::ros2 {

/// What an observer of a service sees. It is sent only on demand, but its hash is part of the
/// service's hash.
/// @tparam Service  such as controller_manager_msgs::srv::LoadController<Jazzy>
template <class Service>
struct ServiceEvent {
  service_msgs::msg::ServiceEventInfo info{};
  BoundedSequence<typename Service::Request, 1> request{};
  BoundedSequence<typename Service::Response, 1> response{};

  static constexpr TypeName ros_type = joined(Service::ros_type, "_Event");
  static constexpr FieldNames<3> ros_fields{"info", "request", "response"};
};

/// A service as a type, of which ROS publishes the hash. No bytes of it are ever sent.
template <class Service>
struct ServiceType {
  typename Service::Request request_message{};
  typename Service::Response response_message{};
  ServiceEvent<Service> event_message{};

  static constexpr TypeName ros_type = Service::ros_type;
  static constexpr FieldNames<3> ros_fields{"request_message", "response_message", "event_message"};
};

}  // namespace articula::ros2
