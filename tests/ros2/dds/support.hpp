// SPDX-License-Identifier: Apache-2.0
/// @file What tests of the transport share: endpoints, messages, and waiting with a limit.
#pragma once

#include "articula/ros2/cdr_decoder.hpp"
#include "articula/ros2/cdr_encoder.hpp"
#include "articula/ros2/dds/fast_dds_transport.hpp"
#include "articula/ros2/messages/std_msgs.hpp"
#include "articula/ros2/messages/std_srvs.hpp"
#include "articula/ros2/type_hash.hpp"

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace articula::ros2::test {

using TextMessage = std_msgs::msg::String<Jazzy>;
using Trigger = std_srvs::srv::Trigger<Jazzy>;

/// A domain that other test programs at the same time hardly have.
inline unsigned domain() { return 1 + static_cast<unsigned>(getpid()) % 100; }

inline TopicEndpoint text_topic(const std::string& topic, QualityOfService quality) {
  return {.node = "/tester",
          .topic = topic,
          .type = std::string(TextMessage::ros_type.view()),
          .hash = std::string(type_hash<TextMessage>.view()),
          .quality = quality};
}

inline ServiceEndpoint trigger_service(const std::string& service) {
  return {.node = "/tester",
          .service = service,
          .request_type = "std_srvs/srv/Trigger_Request",
          .response_type = "std_srvs/srv/Trigger_Response",
          .hash = "RIHS01_" + std::string(64, '5')};
}

template <class M>
std::vector<std::byte> bytes_of(const M& message, std::size_t room = 1024) {
  std::vector<std::byte> bytes(room);
  bytes.resize(encode(message, bytes).size);
  return bytes;
}

inline std::vector<std::byte> text_bytes(const std::string& text) {
  return bytes_of(TextMessage{.data = text}, text.size() + 64);
}

inline std::string text_of(Sample sample) {
  TextMessage text;
  return decode(sample, text) == CdrError::none ? text.data : "not a text";
}

/// Polls until the condition holds, at most for a minute.
template <class Condition>
bool poll_until(Transport& transport, Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    transport.poll(std::chrono::milliseconds(5));
  }
  return true;
}

/// Polls for a time.
inline void poll_for(Transport& transport, std::chrono::milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) transport.poll(std::chrono::milliseconds(5));
}

}  // namespace articula::ros2::test
