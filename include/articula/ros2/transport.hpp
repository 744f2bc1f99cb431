// SPDX-License-Identifier: Apache-2.0
/// @file The transport that ROS 2 needs below it: topics and services as bytes.
#pragma once

#include "articula/ros2/quality_of_service.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace articula::ros2 {

/// A topic as ROS sees it. The transport makes the names of DDS from it.
struct TopicEndpoint {
  std::string node{};   ///< full name of the node it belongs to, as /controller_manager
  std::string topic{};  ///< full name, as /joint_states
  std::string type{};   ///< as sensor_msgs/msg/JointState
  std::string hash{};   ///< of the type, as RIHS01_...; empty: the distribution has none
  QualityOfService quality{};
};

/// A service as ROS sees it, for its server or a client.
struct ServiceEndpoint {
  std::string node{};           ///< full name of the node it belongs to
  std::string service{};        ///< full name, as /controller_manager/list_controllers
  std::string request_type{};   ///< as controller_manager_msgs/srv/ListControllers_Request
  std::string response_type{};  ///< likewise
  std::string hash{};           ///< of the service's type; empty: the distribution has none
  QualityOfService quality = quality_of_service::service;
};

/// Bytes of one message: CDR with its header of four bytes.
using Sample = std::span<const std::byte>;

/// Sends one topic's messages.
class SampleWriter {
 public:
  virtual ~SampleWriter() = default;
  /// Sends a message. The bytes are copied. Never waits for a reader.
  virtual void write(Sample sample) = 0;
  /// The number of matched readers.
  [[nodiscard]] virtual std::size_t readers() const = 0;
};

/// Sends the reply to one request. It may be called once, later than the request came, while the
/// transport exists, in the thread that calls `Transport::poll`.
using ReplySender = std::function<void(Sample reply)>;

/// Carries topics and services. One thread owns it: all its functions, and the functions it was
/// given, are called in the thread that calls `poll`. Real-time: no.
class Transport {
 public:
  /// Receives a message. The bytes are valid during the call. They may be anything.
  using OnSample = std::function<void(Sample sample)>;
  /// Receives a request and how to reply. Without a reply the client's wait ends by its own time.
  using OnRequest = std::function<void(Sample request, ReplySender reply)>;

  virtual ~Transport() = default;
  [[nodiscard]] virtual std::unique_ptr<SampleWriter> advertise(const TopicEndpoint& topic) = 0;
  /// Calls a function for each message of a topic until the transport ends.
  virtual void subscribe(const TopicEndpoint& topic, OnSample on_sample) = 0;
  /// Calls a function for each request to a service until the transport ends.
  virtual void serve(const ServiceEndpoint& service, OnRequest on_request) = 0;
  /// Delivers what has come, or waits for something to come.
  /// @param longest  the longest wait
  virtual void poll(std::chrono::microseconds longest) = 0;
  /// What has come since the last call that users should know, as of a publisher that nobody hears.
  [[nodiscard]] virtual std::vector<std::string> warnings() { return {}; }
};

}  // namespace articula::ros2
