// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/participant.hpp"

#include "articula/core/refuse.hpp"
#include "articula/ros2/dds/full_names.hpp"
#include "articula/ros2/dds/participant_attributes.hpp"
#include "articula/ros2/names.hpp"

#include <fastdds/dds/log/Log.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace articula::ros2::dds {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

// More requests than this do not wait for `poll`, and fewer replies than this are not kept until
// their client has confirmed them.
constexpr std::size_t most_requests = 100;
constexpr std::size_t least_replies = 64;
// The dialect of rmw_cyclonedds has as many bytes more in requests and replies.
constexpr std::size_t dialect_header = 16;
// A packet may be lost, and what a writer sends last may be a stop. Its readers get as long to ask
// for it again, which is more than a period of heartbeats.
constexpr std::chrono::milliseconds longest_last_wait{300};

rtps::RTPSParticipant* make_participant(const FastDdsOptions& options,
                                        const std::shared_ptr<PacketGuard>& guard) {
  check(options);
  if (!options.log) eprosima::fastdds::dds::Log::ClearConsumers();
  rtps::RTPSParticipant* const participant =
      rtps::RTPSDomain::createParticipant(options.domain, participant_attributes(options, guard));
  // Fast DDS 2.9.1 makes participants without sockets, too.
  if (participant == nullptr || !guard->has_sockets()) {
    if (participant != nullptr) rtps::RTPSDomain::removeRTPSParticipant(participant);
    throw std::runtime_error(articula::detail::message_of(
        {"ros2: Fast DDS cannot receive in domain ", options.domain,
         "; expected two free UDP ports from ", 7400 + 250 * options.domain,
         " on, and that this program may open more files"}));
  }
  return participant;
}

}  // namespace

void Participant::RemoveParticipant::operator()(rtps::RTPSParticipant* participant) const {
  rtps::RTPSDomain::removeRTPSParticipant(participant);
}

Participant::Participant(FastDdsOptions options, Distribution distribution)
    : options_(std::move(options)),
      distribution_(distribution),
      participant_(make_participant(options_, guard_)) {
  graph_writer_ = std::make_unique<Writer>(
      *participant_, inbox_,
      Endpoint{std::string(discovery_info_topic), dds_type_name(discovery_info_type),
               discovery_info_hash(distribution_), quality_of_service::discovery_info,
               options_.largest_message});
}

Participant::~Participant() {
  std::vector<Writer*> all{graph_writer_.get()};
  for (const auto& writer : writers_) all.push_back(writer.get());
  for (const auto& leaving : leaving_writers_) all.push_back(leaving.writer.get());
  for (const auto& service : services_) all.push_back(&service.second->writer());
  const Clock::time_point end = Clock::now() + longest_last_wait;
  for (Writer* const writer : all) writer->request_acknowledgements();
  for (Writer* const writer : all) writer->await_acknowledgements(end);
}

Endpoint Participant::endpoint_of(const TopicEndpoint& topic) const {
  const std::string& name = topic.topic;
  check_full_name("topic", name);
  check_type_name(topic.type);
  if (topic.quality.depth == 0) {
    articula::detail::refuse({"ros2: the depth of ", name, " is 0; expected at least 1"});
  }
  return {topic_name(name), dds_type_name(topic.type), topic.hash, topic.quality,
          options_.largest_message};
}

Writer& Participant::advertise(const TopicEndpoint& topic) {
  check_full_name("node", topic.node);
  writers_.push_back(std::make_unique<Writer>(*participant_, inbox_, endpoint_of(topic)));
  graph_.add(topic.node, writers_.back()->guid());
  graph_changed_ = true;
  return *writers_.back();
}

void Participant::remove(const Writer& writer) {
  graph_.remove(writer.guid());
  graph_changed_ = true;
  const auto own = std::find_if(writers_.begin(), writers_.end(),
                                [&](const auto& other) { return other.get() == &writer; });
  if (own == writers_.end()) return;
  (*own)->request_acknowledgements();
  leaving_writers_.push_back({std::move(*own), Clock::now() + longest_last_wait});
  writers_.erase(own);
}

void Participant::subscribe(const TopicEndpoint& topic, Transport::OnSample on_sample) {
  check_full_name("node", topic.node);
  readers_.push_back(std::make_unique<Reader>(
      *participant_, guard_, inbox_, endpoint_of(topic),
      [call = std::move(on_sample)](const Arrival& arrival) { call(arrival.bytes); }));
  graph_.add(topic.node, readers_.back()->guid());
  graph_changed_ = true;
}

void Participant::serve(const ServiceEndpoint& service, Transport::OnRequest on_request) {
  check_full_name("node", service.node);
  const std::string& name = service.service;
  check_full_name("service", name);
  check_type_name(service.request_type);
  check_type_name(service.response_type);
  if (services_.contains(name)) {
    articula::detail::refuse({"ros2: the service ", name, " is served already"});
  }
  Endpoint requests{request_topic_name(name), dds_type_name(service.request_type), service.hash,
                    service.quality, options_.largest_message + dialect_header};
  Endpoint replies = requests;
  requests.quality.depth = std::clamp<std::size_t>(service.quality.depth, 1, most_requests);
  replies.topic = reply_topic_name(name);
  replies.type = dds_type_name(service.response_type);
  replies.quality.depth = std::clamp(service.quality.depth, least_replies, most_requests);

  auto server = std::make_unique<ServiceServer>(*participant_, inbox_, guard_, requests, replies);
  server->on_request(
      [this, server = server.get(), call = std::move(on_request)](
          Sample request, const Client& client) { call(request, reply_sender(*server, client)); });
  graph_.add(service.node, server->reader().guid());
  graph_.add(service.node, server->writer().guid());
  graph_changed_ = true;
  services_.emplace(name, std::move(server));
}

ReplySender Participant::reply_sender(ServiceServer& service, const Client& client) {
  // Copies of the sender share whether it was called.
  return [alive = weak_from_this(), &service, client,
          called = std::make_shared<bool>(false)](Sample bytes) {
    const auto participant = alive.lock();
    if (participant == nullptr || std::exchange(*called, true)) return;
    participant->reply(service, client, bytes);
  };
}

void Participant::reply(ServiceServer& service, const Client& client, Sample bytes) {
  if (bytes.size() > options_.largest_message) {
    articula::detail::refuse({"ros2: a reply of ", bytes.size(),
                              " bytes; FastDdsOptions::largest_message is ",
                              options_.largest_message});
  }
  if (service.reaches(client)) {
    service.reply(client, bytes);
    return;
  }
  if (options_.waiting_replies == 0) return;
  if (waiting_replies_.size() >= options_.waiting_replies) waiting_replies_.pop_front();
  waiting_replies_.push_back(
      {&service, client, {bytes.begin(), bytes.end()}, Clock::now() + options_.reply_patience});
}

void Participant::send_waiting_replies() {
  const Clock::time_point now = Clock::now();
  std::erase_if(waiting_replies_, [&](const WaitingReply& waiting) {
    const bool late = now >= waiting.deadline;
    if (!late && !waiting.service->reaches(waiting.client)) return false;
    // A late reply goes to those of the client's readers that are known, perhaps the right one.
    waiting.service->reply(waiting.client, waiting.bytes);
    return true;
  });
}

void Participant::send_graph() {
  if (!std::exchange(graph_changed_, false)) return;
  graph_writer_->write(graph_.message(distribution_, participant_->getGuid()));
}

void Participant::remove_leaving_writers() {
  const Clock::time_point now = Clock::now();
  std::erase_if(leaving_writers_, [&](const LeavingWriter& leaving) {
    return now >= leaving.deadline || leaving.writer->await_acknowledgements(now);
  });
}

std::vector<std::string> Participant::warnings() {
  std::vector<std::string> all;
  for (const auto& reader : readers_) {
    if (auto warning = reader->warning()) all.push_back(std::move(*warning));
  }
  return all;
}

void Participant::poll(std::chrono::microseconds longest) {
  const Clock::time_point end = Clock::now() + std::max(longest, std::chrono::microseconds(0));
  for (;;) {
    send_graph();
    send_waiting_replies();
    remove_leaving_writers();
    for (const auto& writer : writers_) writer->forget_old();
    const bool any = inbox_.deliver();
    if (any || Clock::now() >= end) return;
    Clock::time_point next = end;
    if (!leaving_writers_.empty()) next = std::min(next, leaving_writers_.front().deadline);
    for (const WaitingReply& waiting : waiting_replies_) next = std::min(next, waiting.deadline);
    inbox_.wait_until(next);
  }
}

}  // namespace articula::ros2::dds
