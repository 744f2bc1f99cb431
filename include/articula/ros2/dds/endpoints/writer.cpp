// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/endpoints/writer.hpp"

#include "articula/core/refuse.hpp"
#include "articula/ros2/names.hpp"

#include <fastdds/rtps/RTPSDomain.h>
#include <fastdds/rtps/participant/RTPSParticipant.h>
#include <fastdds/rtps/writer/StatefulWriter.h>
#include <fastrtps/qos/WriterQos.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace articula::ros2::dds {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

constexpr std::size_t kept_largest_messages = 8;
// Larger messages are sent in fragments, each in a UDP packet.
constexpr std::size_t largest_unfragmented_message = 60'000;
const eprosima::fastrtps::Duration_t heartbeat_period = {0, 200'000'000};

}  // namespace

Writer::Writer(rtps::RTPSParticipant& participant, Inbox& inbox, Endpoint endpoint,
               eprosima::fastdds::rtps::IReaderDataFilter* filter)
    : inbox_(&inbox),
      endpoint_(std::move(endpoint)),
      sends_replies_(filter != nullptr),
      pool_(std::make_shared<PayloadPool>(endpoint_.largest_message,
                                          kept_largest_messages * endpoint_.largest_message)),
      history_(history_attributes(endpoint_, endpoint_.quality.depth)) {
  rtps::WriterAttributes attributes;
  attributes.endpoint.reliabilityKind = rtps::RELIABLE;
  attributes.endpoint.durabilityKind =
      endpoint_.quality.transient_local ? rtps::TRANSIENT_LOCAL : rtps::VOLATILE;
  attributes.times.heartbeatPeriod = heartbeat_period;
  attributes.matched_readers_allocation = {0, most_matches, 1};
  writer_ = rtps::RTPSDomain::createRTPSWriter(&participant, attributes, pool_, &history_, this);
  if (writer_ == nullptr) {
    throw std::runtime_error("ros2: Fast DDS made no writer of " + endpoint_.topic);
  }
  if (filter != nullptr) writer_->reader_data_filter(filter);

  eprosima::fastrtps::WriterQos quality;
  quality.m_reliability.kind = eprosima::fastrtps::RELIABLE_RELIABILITY_QOS;
  quality.m_durability.kind = endpoint_.quality.transient_local
                                  ? eprosima::fastrtps::TRANSIENT_LOCAL_DURABILITY_QOS
                                  : eprosima::fastrtps::VOLATILE_DURABILITY_QOS;
  const auto lifespan = static_cast<std::int32_t>(endpoint_.quality.lifespan.count());
  if (lifespan > 0) quality.m_lifespan.duration = {lifespan, 0};
  if (!endpoint_.hash.empty()) {
    quality.m_userData.data_vec(octets(type_hash_user_data(endpoint_.hash)));
  }
  if (!participant.registerWriter(writer_, topic_attributes(endpoint_), quality)) {
    rtps::RTPSDomain::removeRTPSWriter(writer_);
    throw std::runtime_error("ros2: Fast DDS announced no writer of " + endpoint_.topic);
  }
}

Writer::~Writer() { rtps::RTPSDomain::removeRTPSWriter(writer_); }

void Writer::write(Sample sample, const rtps::SampleIdentity& related) {
  if (sample.size() > endpoint_.largest_message) {
    articula::detail::refuse({"ros2: a message of ", sample.size(), " bytes for ", endpoint_.topic,
                              "; FastDdsOptions::largest_message is ", endpoint_.largest_message});
  }
  if (!endpoint_.quality.transient_local && readers_.count() == 0) return;
  const auto size = static_cast<std::uint32_t>(sample.size());
  if (sends_replies_ || size > largest_unfragmented_message) send_heartbeat();
  if (history_.getHistorySize() >= endpoint_.quality.depth) history_.remove_min_change();
  const auto make = [&] { return writer_->new_change([size] { return size; }, rtps::ALIVE); };
  rtps::CacheChange_t* change = make();
  while (change == nullptr && history_.remove_min_change()) change = make();
  if (change == nullptr) return;

  change->serializedPayload.encapsulation = CDR_LE;
  change->serializedPayload.length = size;
  std::copy(sample.begin(), sample.end(),
            reinterpret_cast<std::byte*>(change->serializedPayload.data));
  rtps::WriteParams parameters;
  parameters.related_sample_identity(related);
  if (!history_.add_change(change, parameters)) writer_->release_change(change);
}

void Writer::forget_old() {
  const std::chrono::nanoseconds lifespan = endpoint_.quality.lifespan;
  if (lifespan.count() == 0) return;
  rtps::Time_t now;
  rtps::Time_t::now(now);
  rtps::CacheChange_t* oldest = nullptr;
  while (history_.get_min_change(&oldest) &&
         now.to_ns() - oldest->sourceTimestamp.to_ns() > lifespan.count()) {
    history_.remove_min_change();
  }
}

void Writer::send_heartbeat() {
  if (auto* const writer = dynamic_cast<rtps::StatefulWriter*>(writer_)) {
    writer->send_periodic_heartbeat(true, true);
  }
}

void Writer::request_acknowledgements() {
  if (auto* const writer = dynamic_cast<rtps::StatefulWriter*>(writer_)) {
    writer->send_periodic_heartbeat();
  }
}

bool Writer::await_acknowledgements(Inbox::Clock::time_point end) {
  using Seconds = std::chrono::duration<long double>;
  const Seconds left = end - Inbox::Clock::now();
  return writer_->wait_for_all_acked(eprosima::fastrtps::Duration_t(std::max(left.count(), 0.0L)));
}

void Writer::onWriterMatched(rtps::RTPSWriter* /*writer*/, rtps::MatchingInfo& info) {
  readers_.set(info.remoteEndpointGuid, info.status == rtps::MATCHED_MATCHING);
  inbox_->wake();
}

void Writer::onWriterChangeReceivedByAll(rtps::RTPSWriter* /*writer*/,
                                         rtps::CacheChange_t* change) {
  if (!endpoint_.quality.transient_local) history_.remove_change_g(change);
}

}  // namespace articula::ros2::dds
