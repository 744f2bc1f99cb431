// SPDX-License-Identifier: Apache-2.0
/// @file The names of ROS 2 topics, services, actions and types in DDS.
#pragma once

#include "articula/ros2/fields.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace articula::ros2 {

/// The DDS topic of a ROS topic, as rt/joint_states.
/// @param name  full name, with the slash at its beginning
/// Real-time: no (allocates); likewise all functions of this header.
inline std::string topic_name(std::string_view name) { return "rt" + std::string(name); }

/// The DDS topic of requests to a service, as rq/arm/list_parametersRequest.
/// @param name  full name of the service
inline std::string request_topic_name(std::string_view name) {
  return "rq" + std::string(name) + "Request";
}

/// The DDS topic of the replies of a service, as rr/arm/list_parametersReply.
/// @param name  full name of the service
inline std::string reply_topic_name(std::string_view name) {
  return "rr" + std::string(name) + "Reply";
}

/// The ROS names of what an action consists of.
/// @param action  full name of the action
inline std::string send_goal_name(std::string_view action) {
  return std::string(action) + "/_action/send_goal";
}
inline std::string get_result_name(std::string_view action) {
  return std::string(action) + "/_action/get_result";
}
inline std::string cancel_goal_name(std::string_view action) {
  return std::string(action) + "/_action/cancel_goal";
}
inline std::string feedback_name(std::string_view action) {
  return std::string(action) + "/_action/feedback";
}
inline std::string status_name(std::string_view action) {
  return std::string(action) + "/_action/status";
}

/// The DDS name of a ROS type, as std_msgs::msg::dds_::Header_ for std_msgs/msg/Header.
/// @param type  package, kind and name
inline std::string dds_type_name(std::string_view type) {
  const std::size_t kind = type.find('/') + 1, name = type.rfind('/') + 1;
  return std::string(type.substr(0, kind - 1)) +
         "::" + std::string(type.substr(kind, name - 1 - kind)) +
         "::dds_::" + std::string(type.substr(name)) + "_";
}

/// The DDS name of a message struct's type.
template <Message M>
std::string dds_type_name() {
  return dds_type_name(M::ros_type.view());
}

/// The USER_DATA of a reader or writer by which ROS finds the hash of its type.
/// @param type_hash  of a message; of a service in its event type, see `Service`
inline std::string type_hash_user_data(std::string_view type_hash) {
  return "typehash=" + std::string(type_hash) + ";";
}

}  // namespace articula::ros2
