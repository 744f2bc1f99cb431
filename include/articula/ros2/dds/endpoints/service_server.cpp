// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/endpoints/service_server.hpp"

#include <algorithm>

namespace articula::ros2::dds {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

constexpr std::size_t cdr_header = 4;

bool is_big_endian(Sample message) { return (message[1] & std::byte{1}) == std::byte{0}; }

// Implementations of DDS begin their identifiers with the number of their vendor.
bool is_cyclone(const rtps::GUID_t& guid) {
  return guid.guidPrefix.value[0] == 0x01 && guid.guidPrefix.value[1] == 0x10;
}

}  // namespace

bool ClientFilter::is_relevant(const rtps::CacheChange_t& change,
                               const rtps::GUID_t& reader) const {
  const rtps::GUID_t& client = change.write_params.related_sample_identity().writer_guid();
  return is_reader(client) ? client == reader : client.guidPrefix == reader.guidPrefix;
}

ServiceServer::ServiceServer(rtps::RTPSParticipant& participant, Inbox& inbox,
                             std::shared_ptr<PacketGuard> guard, const Endpoint& requests,
                             const Endpoint& replies)
    : writer_(participant, inbox, replies, &filter_),
      reader_(participant, std::move(guard), inbox, requests,
              [this](const Arrival& arrival) { take(arrival); }) {}

void ServiceServer::take(const Arrival& arrival) {
  Client client;
  client.related = arrival.identity;
  client.is_cyclone = is_cyclone(arrival.identity.writer_guid());
  if (!client.is_cyclone) {
    const rtps::GUID_t& reader = arrival.related.writer_guid();
    if (reader != rtps::GUID_t::unknown()) client.related.writer_guid(reader);
    on_request_(arrival.bytes, client);
    return;
  }
  const Sample bytes = arrival.bytes;
  if (bytes.size() < cdr_header + client.header.size()) return;
  client.is_big_endian = is_big_endian(bytes);
  std::copy_n(bytes.begin() + cdr_header, client.header.size(), client.header.begin());
  // Without the dialect's 16 bytes all numbers stay aligned.
  std::vector<std::byte> request(bytes.begin(), bytes.begin() + cdr_header);
  request.insert(request.end(), bytes.begin() + cdr_header + client.header.size(), bytes.end());
  on_request_(request, client);
}

bool ServiceServer::reaches(const Client& client) const {
  const rtps::GUID_t& guid = client.related.writer_guid();
  if (is_reader(guid)) return writer_.readers().contains(guid);
  // The request does not name the reader. Each client of a participant has a writer and a reader,
  // so that all of its readers are known if they are as many as its writers.
  const std::size_t readers = writer_.readers().count(guid.guidPrefix);
  return readers > 0 && readers >= reader_.writers().count(guid.guidPrefix);
}

void ServiceServer::reply(const Client& client, Sample reply) {
  if (!client.is_cyclone || reply.size() < cdr_header) {
    writer_.write(reply, client.related);
    return;
  }
  std::array<std::byte, 16> header = client.header;
  if (client.is_big_endian != is_big_endian(reply)) {
    std::reverse(header.begin(), header.begin() + 8);
    std::reverse(header.begin() + 8, header.end());
  }
  std::vector<std::byte> bytes(reply.begin(), reply.begin() + cdr_header);
  bytes.insert(bytes.end(), header.begin(), header.end());
  bytes.insert(bytes.end(), reply.begin() + cdr_header, reply.end());
  writer_.write(bytes, client.related);
}

}  // namespace articula::ros2::dds
