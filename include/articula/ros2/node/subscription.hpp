// SPDX-License-Identifier: Apache-2.0
/// @file Messages of one type in from a topic.
#pragma once

#include "articula/ros2/cdr_decoder.hpp"
#include "articula/ros2/node/node.hpp"

#include <memory>
#include <string_view>
#include <utility>

namespace articula::ros2 {

/// Calls function(message) for each message of a topic, until transport or context end. Bytes that
/// are no message of the type are dropped and counted in Context::dropped.
/// @tparam M    message
/// @param name  of the topic, see Node::full_name
/// Real-time: no (allocates).
template <Message M, class Function>
void subscribe(const Node& node, std::string_view name, QualityOfService quality,
               Function function) {
  Context& context = node.context();
  context.transport().subscribe(
      node.topic<M>(name, quality),
      [&context, alive = context.lifetime(), function = std::move(function)](Sample sample) {
        if (alive.expired()) return;
        M message{};
        if (decode(sample, message) == CdrError::none) {
          function(message);
        } else {
          ++context.dropped.malformed;
        }
      });
}

}  // namespace articula::ros2
