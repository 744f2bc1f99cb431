// SPDX-License-Identifier: Apache-2.0
/// @file A ROS 2 transport within a test, and the clients that talk through it.
#pragma once

#include "articula/ros2/cdr_decoder.hpp"
#include "articula/ros2/cdr_encoder.hpp"
#include "articula/ros2/transport.hpp"

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace support {

using Bytes = std::vector<std::byte>;

/// The bytes of a message.
template <articula::ros2::Message M>
Bytes bytes_of(const M& message) {
  Bytes bytes(1 << 16);
  auto encoded = articula::ros2::encode(message, bytes);
  while (encoded.error == articula::ros2::CdrError::no_room) {
    bytes.resize(2 * bytes.size());
    encoded = articula::ros2::encode(message, bytes);
  }
  bytes.resize(encoded.size);
  return bytes;
}

/// Topics and services without a network. Everything is delivered at once.
class MemoryTransport : public articula::ros2::Transport {
 public:
  struct Topic {
    articula::ros2::TopicEndpoint endpoint{};
    std::deque<Bytes> sent{};  ///< the last 100
    std::size_t count = 0;     ///< of all that were sent
    std::vector<OnSample> readers{};
    std::size_t clients = 1;  ///< that read what is sent
  };
  struct Service {
    articula::ros2::ServiceEndpoint endpoint{};
    OnRequest server{};
  };

  std::unique_ptr<articula::ros2::SampleWriter> advertise(
      const articula::ros2::TopicEndpoint& topic) override {
    topics[topic.topic].endpoint = topic;
    return std::make_unique<Writer>(topics[topic.topic]);
  }
  void subscribe(const articula::ros2::TopicEndpoint& topic, OnSample on_sample) override {
    topics[topic.topic].endpoint = topic;
    topics[topic.topic].readers.push_back(std::move(on_sample));
  }
  void serve(const articula::ros2::ServiceEndpoint& service, OnRequest on_request) override {
    services[service.service] = {service, std::move(on_request)};
  }
  void poll(std::chrono::microseconds) override {}
  std::vector<std::string> warnings() override { return std::exchange(own_warnings, {}); }

  std::vector<std::string> own_warnings{};  ///< for the next call of warnings

  /// Sends bytes to the readers of a topic.
  void publish(const std::string& topic, articula::ros2::Sample bytes) {
    for (const OnSample& reader : topics.at(topic).readers) reader(bytes);
  }
  /// Sends a request, whose reply comes when `*reply` has bytes.
  std::shared_ptr<Bytes> request(const std::string& service, articula::ros2::Sample bytes) {
    auto reply = std::make_shared<Bytes>();
    services.at(service).server(bytes, [reply](articula::ros2::Sample sample) {
      reply->assign(sample.begin(), sample.end());
    });
    return reply;
  }

  /// The last message of a topic.
  template <articula::ros2::Message M>
  std::optional<M> last(const std::string& topic) const {
    const auto found = topics.find(topic);
    if (found == topics.end() || found->second.sent.empty()) return std::nullopt;
    M message{};
    if (articula::ros2::decode(found->second.sent.back(), message) !=
        articula::ros2::CdrError::none) {
      return std::nullopt;
    }
    return message;
  }

  std::map<std::string, Topic> topics{};
  std::map<std::string, Service> services{};

 private:
  class Writer final : public articula::ros2::SampleWriter {
   public:
    explicit Writer(Topic& topic) : topic_(topic) {}
    void write(articula::ros2::Sample sample) override {
      topic_.sent.emplace_back(sample.begin(), sample.end());
      if (topic_.sent.size() > 100) topic_.sent.pop_front();
      ++topic_.count;
    }
    [[nodiscard]] std::size_t readers() const override { return topic_.clients; }

   private:
    Topic& topic_;
  };
};

}  // namespace support
