// SPDX-License-Identifier: Apache-2.0
/// @file Requests of one type in, and replies to them, at once or later.
#pragma once

#include "articula/ros2/cdr_decoder.hpp"
#include "articula/ros2/message_buffer.hpp"
#include "articula/ros2/node/node.hpp"

#include <memory>
#include <string_view>
#include <utility>

namespace articula::ros2 {

/// Sends the reply to one request, at once or later, once.
/// @tparam Service  such as controller_manager_msgs::srv::SwitchController<Jazzy>
template <class Service>
class Reply {
 public:
  explicit Reply(ReplySender sender) : sender_(std::move(sender)) {}

  /// Sends it. A reply that cannot be encoded is not sent, and the client's time ends its wait.
  /// Real-time: no (allocates).
  void send(const typename Service::Response& response) const {
    MessageBuffer buffer;
    if (const Sample bytes = buffer.encode(response); !bytes.empty()) sender_(bytes);
  }

 private:
  ReplySender sender_;
};

/// Calls function(request, reply) for each request to a service, until transport or context end.
/// Requests that cannot be decoded are dropped and counted in Context::dropped.
/// @tparam Service  with Request and Response
/// @param name      of the service, see Node::full_name
/// Real-time: no (allocates).
template <class Service, class Function>
void serve(const Node& node, std::string_view name, Function function,
           QualityOfService quality = quality_of_service::service) {
  Context& context = node.context();
  context.transport().serve(node.service<Service>(name, quality),
                            [&context, alive = context.lifetime(), function = std::move(function)](
                                Sample sample, ReplySender sender) {
                              if (alive.expired()) return;
                              typename Service::Request request{};
                              if (decode(sample, request) == CdrError::none) {
                                function(request, Reply<Service>(std::move(sender)));
                              } else {
                                ++context.dropped.malformed;
                              }
                            });
}

}  // namespace articula::ros2
