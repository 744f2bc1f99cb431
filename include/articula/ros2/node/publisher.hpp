// SPDX-License-Identifier: Apache-2.0
/// @file Messages of one type out to a topic.
#pragma once

#include "articula/ros2/message_buffer.hpp"
#include "articula/ros2/node/node.hpp"

#include <cstddef>
#include <memory>
#include <string_view>

namespace articula::ros2 {

/// Sends messages of a type to a topic. In the thread that polls the transport.
template <Message M>
class Publisher {
 public:
  /// @param node  its node
  /// @param name  of the topic, see Node::full_name
  Publisher(const Node& node, std::string_view name, QualityOfService quality)
      : writer_(node.context().transport().advertise(node.topic<M>(name, quality))) {}

  /// Sends a message. One that cannot be encoded (a text with a NUL in it) is not sent.
  /// Real-time: no (allocates).
  void publish(const M& message) {
    if (const Sample bytes = buffer_.encode(message); !bytes.empty()) writer_->write(bytes);
  }
  /// The number of readers.
  [[nodiscard]] std::size_t readers() const { return writer_->readers(); }

 private:
  std::unique_ptr<SampleWriter> writer_;
  MessageBuffer buffer_{};
};

}  // namespace articula::ros2
