// SPDX-License-Identifier: Apache-2.0
/// @file ROS 2's topics and services over Fast DDS.
#pragma once

#include "articula/ros2/dds/fast_dds_options.hpp"
#include "articula/ros2/layout.hpp"
#include "articula/ros2/transport.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace articula::ros2 {

namespace dds {
class Participant;
}

/// A participant of a DDS domain, as ROS 2 programs see each other. It needs the target
/// articula::ros2.
///
/// Services answer clients of rmw_fastrtps and of rmw_cyclonedds. Threads of Fast DDS receive;
/// they run no function of the user and do not wait for one. They inherit the scheduling of the
/// thread that makes the transport. Whatever peers send, each topic and service keeps at most as
/// many messages as its quality of service states and 4 times `largest_message` bytes. The oldest
/// ones are dropped.
///
/// All functions are of one thread. Real-time: no.
class FastDdsTransport final : public Transport {
 public:
  /// @param distribution  whose tools are to see the nodes
  /// @throws std::invalid_argument for options out of their range, and interfaces that this host
  ///         does not have
  /// @throws std::runtime_error if Fast DDS cannot make a participant
  explicit FastDdsTransport(const FastDdsOptions& options = {},
                            Distribution distribution = Distribution::jazzy);
  FastDdsTransport(const FastDdsTransport&) = delete;
  FastDdsTransport& operator=(const FastDdsTransport&) = delete;
  ~FastDdsTransport() override;

  /// The writer ends with the transport or before it. Afterwards its `write` does nothing. `write`
  /// throws std::invalid_argument if the message is larger than `largest_message`, and
  /// `ReplySender` likewise.
  /// @throws std::invalid_argument for names that ROS does not have
  [[nodiscard]] std::unique_ptr<SampleWriter> advertise(const TopicEndpoint& topic) override;
  /// @throws std::invalid_argument for names that ROS does not have
  void subscribe(const TopicEndpoint& topic, OnSample on_sample) override;
  /// @throws std::invalid_argument for names that ROS does not have, and for a service that this
  ///         transport has already
  void serve(const ServiceEndpoint& service, OnRequest on_request) override;
  /// @param longest  the longest wait; less than 0 is 0
  /// Exceptions of the functions of topics and services pass. The next call continues.
  void poll(std::chrono::microseconds longest) override;
  [[nodiscard]] std::vector<std::string> warnings() override;

 private:
  std::shared_ptr<dds::Participant> participant_;
};

}  // namespace articula::ros2
