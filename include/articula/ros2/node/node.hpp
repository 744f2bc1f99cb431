// SPDX-License-Identifier: Apache-2.0
/// @file A node of ROS: the name under which topics, services and parameters are found.
#pragma once

#include "articula/ros2/messages/service_msgs.hpp"
#include "articula/ros2/node/context.hpp"
#include "articula/ros2/type_hash.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace articula::ros2 {

/// A node. Its parts are made by `Publisher`, `subscribe`, `serve`, `ActionServer` and
/// `ParameterServer`. Real-time: no (allocates).
class Node {
 public:
  /// @param context     outlives the node
  /// @param name        as "controller_manager"
  /// @param name_space  as "/left"; empty or "/" for none
  Node(Context& context, std::string_view name, std::string_view name_space = {})
      : context_(context), name_space_(name_space == "/" ? std::string_view() : name_space) {
    name_ = name_space_ + "/" + std::string(name);
  }

  [[nodiscard]] Context& context() const noexcept { return context_; }
  /// With its namespace, as "/left/controller_manager".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// The full name of a topic, service or action.
  /// @param name  "/tf" is a full name, "~/state" begins with the node's, "tf" with its namespace's
  [[nodiscard]] std::string full_name(std::string_view name) const {
    if (name.starts_with("/")) return std::string(name);
    if (name.starts_with("~/")) return name_ + std::string(name.substr(1));
    return name_space_ + "/" + std::string(name);
  }

  /// A topic of this node.
  template <Message M>
  [[nodiscard]] TopicEndpoint topic(std::string_view name, QualityOfService quality) const {
    return {name_, full_name(name), std::string(M::ros_type.view()), hash<M>(), quality};
  }
  /// A service of this node.
  template <class Service>
  [[nodiscard]] ServiceEndpoint service(std::string_view name, QualityOfService quality) const {
    return {name_,
            full_name(name),
            std::string(Service::Request::ros_type.view()),
            std::string(Service::Response::ros_type.view()),
            hash<ServiceType<Service>>(),
            quality};
  }

 private:
  /// Computed at run time: the compiler would take seconds for the hash of an action.
  template <Message M>
  [[nodiscard]] std::string hash() const {
    return context_.has_hashes() ? std::string(compute_type_hash<M>().view()) : std::string();
  }

  Context& context_;
  std::string name_space_;
  std::string name_;
};

}  // namespace articula::ros2
