// SPDX-License-Identifier: Apache-2.0
#include "fast_dds_peer.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/test_UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <stdexcept>

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

class RawType final : public fast::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 4 << 20;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<const Bytes*>(data);
    if (payload->max_size < bytes.size()) return false;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    if (!bytes.empty()) std::memcpy(payload->data, bytes.data(), bytes.size());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    const auto* const begin = reinterpret_cast<const std::byte*>(payload->data);
    static_cast<Bytes*>(data)->assign(begin, begin + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [size = static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size())] {
      return size;
    };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

template <class Quality>
void set(Quality& quality, bool transient_local, int depth) {
  quality.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  quality.durability().kind =
      transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  quality.history().kind = fast::KEEP_LAST_HISTORY_QOS;
  quality.history().depth = depth;
  quality.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  quality.data_sharing().off();
}

std::shared_ptr<eprosima::fastdds::rtps::SocketTransportDescriptor> make_udp(
    const FastDdsPeer::Options& options) {
  namespace transports = eprosima::fastdds::rtps;
  if (!options.loses) return std::make_shared<transports::UDPv4TransportDescriptor>();
  auto udp = std::make_shared<transports::test_UDPv4TransportDescriptor>();
  // From a part without its head: the numbers of message and fragment begin at these bytes.
  constexpr std::uint32_t low_word = 16, first_fragment = 20;
  const auto number_at = [](const rtps::CDRMessage_t& message, std::uint32_t place) {
    std::uint32_t number = 0;  // little endian, as this machine
    std::memcpy(&number, message.buffer + message.pos + place, sizeof number);
    return number;
  };
  udp->drop_data_messages_filter_ = [=, loses = options.loses](rtps::CDRMessage_t& message) {
    return loses(number_at(message, low_word), 0);
  };
  udp->drop_data_frag_messages_filter_ = [=, loses = options.loses](rtps::CDRMessage_t& message) {
    return loses(number_at(message, low_word), number_at(message, first_fragment));
  };
  return udp;
}

}  // namespace

void talk_over_udp_only() {
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
}

struct FastDdsPeer::Entities {
  int depth = 0;
  fast::DomainParticipant* participant = nullptr;
  fast::Publisher* publisher = nullptr;
  fast::Subscriber* subscriber = nullptr;
  std::map<std::string, fast::Topic*> topics{};
  std::vector<fast::DataWriter*> writers{};
  std::vector<fast::DataReader*> readers{};

  fast::Topic* topic(const std::string& name, const std::string& type) {
    fast::Topic*& topic = topics[name];
    if (topic == nullptr) {
      participant->register_type(fast::TypeSupport(new RawType(type)));
      topic = participant->create_topic(name, type, fast::TOPIC_QOS_DEFAULT);
    }
    return topic;
  }
};

FastDdsPeer::FastDdsPeer(unsigned domain, const Options& options)
    : entities_(std::make_unique<Entities>()) {
  fast::DomainParticipantQos quality;
  quality.transport().use_builtin_transports = false;
  const auto udp = make_udp(options);
  udp->interfaceWhiteList = {"127.0.0.1"};
  quality.transport().user_transports = {udp};
  rtps::Locator_t loopback;
  loopback.kind = LOCATOR_KIND_UDPv4;
  rtps::IPLocator::setIPv4(loopback, "127.0.0.1");
  quality.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(loopback);
  quality.wire_protocol().builtin.initialPeersList.push_back(loopback);
  if (options.poses_as_cyclone) {
    const unsigned char prefix[] = {0x01, 0x10, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    std::copy(std::begin(prefix), std::end(prefix), quality.wire_protocol().prefix.value);
  }
  if (options.joins_group) {
    rtps::Locator_t group = loopback;
    rtps::IPLocator::setIPv4(group, "239.255.9.9");
    group.port = 20000 + domain;
    quality.wire_protocol().default_multicast_locator_list.push_back(group);
    quality.wire_protocol().default_unicast_locator_list.push_back(loopback);
  }
  Entities& e = *entities_;
  e.depth = options.depth;
  e.participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(domain, quality);
  if (e.participant == nullptr) throw std::runtime_error("no participant");
  e.publisher = e.participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  e.subscriber = e.participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
}

FastDdsPeer::~FastDdsPeer() {
  entities_->participant->delete_contained_entities();
  fast::DomainParticipantFactory::get_instance()->delete_participant(entities_->participant);
}

std::size_t FastDdsPeer::make_writer(const std::string& topic, const std::string& type,
                                     bool transient_local, bool best_effort) {
  fast::DataWriterQos quality;
  set(quality, transient_local, entities_->depth);
  if (best_effort) quality.reliability().kind = fast::BEST_EFFORT_RELIABILITY_QOS;
  auto* writer = entities_->publisher->create_datawriter(entities_->topic(topic, type), quality);
  if (writer == nullptr) throw std::runtime_error("no writer");
  entities_->writers.push_back(writer);
  return entities_->writers.size() - 1;
}

std::size_t FastDdsPeer::make_reader(const std::string& topic, const std::string& type,
                                     bool transient_local) {
  fast::DataReaderQos quality;
  set(quality, transient_local, entities_->depth);
  auto* reader = entities_->subscriber->create_datareader(entities_->topic(topic, type), quality);
  if (reader == nullptr) throw std::runtime_error("no reader");
  entities_->readers.push_back(reader);
  return entities_->readers.size() - 1;
}

void FastDdsPeer::write(std::size_t writer, std::span<const std::byte> bytes) {
  Bytes copy(bytes.begin(), bytes.end());
  entities_->writers[writer]->write(&copy);
}

std::vector<Bytes> FastDdsPeer::take(std::size_t reader) {
  std::vector<Bytes> all;
  for (Reply& reply : take_replies(reader)) all.push_back(std::move(reply.bytes));
  return all;
}

std::size_t FastDdsPeer::matches_of_writer(std::size_t writer) const {
  fast::PublicationMatchedStatus status;
  entities_->writers[writer]->get_publication_matched_status(status);
  return static_cast<std::size_t>(status.current_count);
}

std::size_t FastDdsPeer::matches_of_reader(std::size_t reader) const {
  fast::SubscriptionMatchedStatus status;
  entities_->readers[reader]->get_subscription_matched_status(status);
  return static_cast<std::size_t>(status.current_count);
}

std::int64_t FastDdsPeer::request(std::size_t writer, std::size_t reader,
                                  std::span<const std::byte> bytes) {
  Bytes copy(bytes.begin(), bytes.end());
  rtps::WriteParams parameters;
  parameters.related_sample_identity().writer_guid() = entities_->readers[reader]->guid();
  entities_->writers[writer]->write(&copy, parameters);
  return static_cast<std::int64_t>(parameters.sample_identity().sequence_number().to64long());
}

std::vector<FastDdsPeer::Reply> FastDdsPeer::take_replies(std::size_t reader) {
  std::vector<Reply> all;
  Bytes bytes;
  fast::SampleInfo info;
  while (entities_->readers[reader]->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
    if (!info.valid_data) continue;
    const auto& related = info.related_sample_identity;
    all.push_back({static_cast<std::int64_t>(related.sequence_number().to64long()),
                   related.writer_guid() == entities_->readers[reader]->guid(), bytes});
  }
  return all;
}
