// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/endpoints/reader.hpp"

#include "articula/ros2/names.hpp"

#include <fastdds/rtps/RTPSDomain.h>
#include <fastdds/rtps/participant/RTPSParticipant.h>
#include <fastrtps/qos/ReaderQos.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace articula::ros2::dds {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

constexpr std::size_t waiting_largest_messages = 4;

PacketGuard::Guid bytes_of(const rtps::GUID_t& guid) {
  constexpr auto to_byte = [](rtps::octet octet) { return std::byte{octet}; };
  PacketGuard::Guid bytes{};
  const auto entity = std::ranges::transform(guid.guidPrefix.value, bytes.begin(), to_byte).out;
  std::ranges::transform(guid.entityId.value, entity, to_byte);
  return bytes;
}

}  // namespace

Reader::Reader(rtps::RTPSParticipant& participant, std::shared_ptr<PacketGuard> guard, Inbox& inbox,
               const Endpoint& endpoint, std::function<void(Arrival&)> deliver)
    : guard_(std::move(guard)),
      inbox_(&inbox),
      topic_(endpoint.topic),
      queue_(endpoint.quality.depth, waiting_largest_messages * endpoint.largest_message,
             std::move(deliver)),
      history_(endpoint.largest_message) {
  rtps::ReaderAttributes attributes;
  attributes.endpoint.reliabilityKind =
      endpoint.quality.best_effort ? rtps::BEST_EFFORT : rtps::RELIABLE;
  attributes.endpoint.durabilityKind =
      endpoint.quality.transient_local ? rtps::TRANSIENT_LOCAL : rtps::VOLATILE;
  attributes.matched_writers_allocation = {0, most_matches, 1};
  reader_ = rtps::RTPSDomain::createRTPSReader(&participant, attributes, history_.pool(), &history_,
                                               this);
  if (reader_ == nullptr) {
    throw std::runtime_error("ros2: Fast DDS made no reader of " + endpoint.topic);
  }

  eprosima::fastrtps::ReaderQos quality;
  quality.m_reliability.kind = endpoint.quality.best_effort
                                   ? eprosima::fastrtps::BEST_EFFORT_RELIABILITY_QOS
                                   : eprosima::fastrtps::RELIABLE_RELIABILITY_QOS;
  quality.m_durability.kind = endpoint.quality.transient_local
                                  ? eprosima::fastrtps::TRANSIENT_LOCAL_DURABILITY_QOS
                                  : eprosima::fastrtps::VOLATILE_DURABILITY_QOS;
  if (!endpoint.hash.empty()) {
    quality.m_userData.data_vec(octets(type_hash_user_data(endpoint.hash)));
  }
  if (!participant.registerReader(reader_, topic_attributes(endpoint), quality)) {
    rtps::RTPSDomain::removeRTPSReader(reader_);
    throw std::runtime_error("ros2: Fast DDS announced no reader of " + endpoint.topic);
  }
}

Reader::~Reader() { rtps::RTPSDomain::removeRTPSReader(reader_); }

std::optional<std::string> Reader::warning() {
  const bool is_unreliable = is_unreliable_.exchange(false);
  const bool is_volatile = is_volatile_.exchange(false);
  if (!is_unreliable && !is_volatile) return {};
  const std::string topic = topic_.substr(topic_.find('/'));  // without DDS's "rt"
  return "a publisher of " + topic + " is not heard: its quality of service is " +
         (is_unreliable ? "best effort; expected reliable" : "volatile; expected transient local");
}

void Reader::on_requested_incompatible_qos(rtps::RTPSReader* /*reader*/,
                                           eprosima::fastdds::dds::PolicyMask policies) {
  using namespace eprosima::fastdds::dds;
  if (policies.test(RELIABILITY_QOS_POLICY_ID)) is_unreliable_ = true;
  if (policies.test(DURABILITY_QOS_POLICY_ID)) is_volatile_ = true;
}

void Reader::onReaderMatched(rtps::RTPSReader* /*reader*/, rtps::MatchingInfo& info) {
  writers_.set(info.remoteEndpointGuid, info.status == rtps::MATCHED_MATCHING);
  inbox_->wake();
}

void Reader::onNewCacheChangeAdded(rtps::RTPSReader* reader, const rtps::CacheChange_t* added) {
  auto* const change = const_cast<rtps::CacheChange_t*>(added);  // taken out of the history
  // Fast DDS 2.9.1 hands on fragments of a message that its writer has declared gone.
  if (change->kind == rtps::ALIVE && change->is_fully_assembled()) {
    Arrival arrival;
    const auto* const data = reinterpret_cast<const std::byte*>(change->serializedPayload.data);
    arrival.bytes.assign(data, data + change->serializedPayload.length);
    arrival.identity.writer_guid(change->writerGUID);
    arrival.identity.sequence_number(rtps::SequenceNumber_t(
        guard_->original(bytes_of(change->writerGUID), change->sequenceNumber.to64long())));
    arrival.related = change->write_params.sample_identity();
    inbox_->put(queue_, std::move(arrival));
  }
  reader->getHistory()->remove_change(change);
}

}  // namespace articula::ros2::dds
