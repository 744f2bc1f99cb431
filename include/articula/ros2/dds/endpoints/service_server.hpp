// SPDX-License-Identifier: Apache-2.0
/// @file A service for clients of both dialects: reader of requests, writer of replies.
#pragma once

#include "articula/ros2/dds/endpoints/reader.hpp"
#include "articula/ros2/dds/endpoints/writer.hpp"
#include "articula/ros2/dds/packets/packet_guard.hpp"
#include "articula/ros2/service_header.hpp"
#include "articula/ros2/transport.hpp"

#include <fastdds/rtps/writer/IReaderDataFilter.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace articula::ros2::dds {

/// Who asked, and what the reply repeats.
struct Client {
  eprosima::fastrtps::rtps::SampleIdentity related{};  ///< in rmw_fastrtps, its reader and number
  bool is_cyclone = false;
  bool is_big_endian = false;
  std::array<std::byte, 16> header{};  ///< in rmw_cyclonedds, from the request
};

// Fast DDS deletes no filter, so its interface has no virtual destructor.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
/// Sends a reply to the participant that asked.
class ClientFilter final : public eprosima::fastdds::rtps::IReaderDataFilter {
 public:
  [[nodiscard]] bool is_relevant(const eprosima::fastrtps::rtps::CacheChange_t& change,
                                 const eprosima::fastrtps::rtps::GUID_t& reader) const override;
};
#pragma GCC diagnostic pop

/// One service. ROS clients consider a service complete if it has one reader and one writer.
class ServiceServer {
 public:
  using OnRequest = std::function<void(Sample request, const Client& client)>;

  /// @param guard              of the participant's packets
  /// @param requests, replies  the two topics
  ServiceServer(eprosima::fastrtps::rtps::RTPSParticipant& participant, Inbox& inbox,
                std::shared_ptr<PacketGuard> guard, const Endpoint& requests,
                const Endpoint& replies);

  /// What to call for each request, in the thread that takes from the inbox.
  void on_request(OnRequest function) { on_request_ = std::move(function); }

  /// Whether the reader that waits for the reply is known.
  [[nodiscard]] bool reaches(const Client& client) const;
  /// Sends a reply.
  /// @throws std::invalid_argument if it is too large
  void reply(const Client& client, Sample reply);

  [[nodiscard]] const Reader& reader() const { return reader_; }
  [[nodiscard]] const Writer& writer() const { return writer_; }
  [[nodiscard]] Writer& writer() { return writer_; }

 private:
  void take(const Arrival& arrival);

  OnRequest on_request_{};
  ClientFilter filter_{};
  Writer writer_;
  Reader reader_;
};

}  // namespace articula::ros2::dds
