// SPDX-License-Identifier: Apache-2.0
/// @file A participant of a DDS domain with its topics, services and nodes.
#pragma once

#include "articula/ros2/dds/endpoints/service_server.hpp"
#include "articula/ros2/dds/fast_dds_options.hpp"
#include "articula/ros2/dds/graph.hpp"
#include "articula/ros2/dds/packets/packet_guard.hpp"

#include <fastdds/rtps/RTPSDomain.h>
#include <fastdds/rtps/participant/RTPSParticipant.h>

#include <chrono>
#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace articula::ros2::dds {

/// What `FastDdsTransport` does, without its interface. All functions are of one thread.
class Participant : public std::enable_shared_from_this<Participant> {
 public:
  Participant(FastDdsOptions options, Distribution distribution);
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  ~Participant();

  Writer& advertise(const TopicEndpoint& topic);
  void remove(const Writer& writer);
  void subscribe(const TopicEndpoint& topic, Transport::OnSample on_sample);
  void serve(const ServiceEndpoint& service, Transport::OnRequest on_request);
  void poll(std::chrono::microseconds longest);
  [[nodiscard]] std::vector<std::string> warnings();

 private:
  using Clock = Inbox::Clock;

  // A reply whose client is not there yet.
  struct WaitingReply {
    ServiceServer* service = nullptr;
    Client client{};
    std::vector<std::byte> bytes{};
    Clock::time_point deadline{};
  };

  // A writer without a user, whose readers may ask for its last messages again.
  struct LeavingWriter {
    std::unique_ptr<Writer> writer{};
    Clock::time_point deadline{};
  };

  struct RemoveParticipant {
    void operator()(eprosima::fastrtps::rtps::RTPSParticipant* participant) const;
  };

  [[nodiscard]] Endpoint endpoint_of(const TopicEndpoint& topic) const;
  [[nodiscard]] ReplySender reply_sender(ServiceServer& service, const Client& client);
  void reply(ServiceServer& service, const Client& client, Sample bytes);
  void send_waiting_replies();
  void send_graph();
  void remove_leaving_writers();

  FastDdsOptions options_;
  Distribution distribution_;
  Inbox inbox_{};
  std::shared_ptr<PacketGuard> guard_ = std::make_shared<PacketGuard>();
  std::unique_ptr<eprosima::fastrtps::rtps::RTPSParticipant, RemoveParticipant> participant_;
  std::vector<std::unique_ptr<Writer>> writers_{};
  std::deque<LeavingWriter> leaving_writers_{};  // earliest deadline first
  std::vector<std::unique_ptr<Reader>> readers_{};
  std::map<std::string, std::unique_ptr<ServiceServer>> services_{};
  std::deque<WaitingReply> waiting_replies_{};
  Graph graph_{};
  std::unique_ptr<Writer> graph_writer_{};
  bool graph_changed_ = true;
};

}  // namespace articula::ros2::dds
