// SPDX-License-Identifier: Apache-2.0
/// @file The topic, type and quality of service of a reader or writer of DDS.
#pragma once

#include "articula/ros2/dds/packets/known_endpoints.hpp"
#include "articula/ros2/quality_of_service.hpp"

#include <fastdds/rtps/attributes/HistoryAttributes.h>
#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/participant/RTPSParticipant.h>
#include <fastrtps/attributes/TopicAttributes.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace articula::ros2::dds {

/// A reader or writer, in the names of DDS.
struct Endpoint {
  std::string topic{};
  std::string type{};
  std::string hash{};  ///< of the type; may be empty
  QualityOfService quality{};
  std::size_t largest_message = 0;  ///< bytes
};

/// Its topic, as Fast DDS announces it.
inline eprosima::fastrtps::TopicAttributes topic_attributes(const Endpoint& endpoint) {
  eprosima::fastrtps::TopicAttributes topic(endpoint.topic.c_str(), endpoint.type.c_str());
  topic.auto_fill_type_object = false;
  topic.auto_fill_type_information = false;
  topic.historyQos.kind = eprosima::fastrtps::KEEP_LAST_HISTORY_QOS;
  topic.historyQos.depth = static_cast<int>(endpoint.quality.depth);
  // Fast DDS checks the depth against its default limits, which the endpoints here do not have.
  topic.resourceLimitsQos.max_samples = topic.historyQos.depth + 1;
  topic.resourceLimitsQos.max_samples_per_instance = topic.historyQos.depth + 1;
  topic.resourceLimitsQos.allocated_samples = 1;
  return topic;
}

/// A history that takes memory when a message comes.
/// @param messages  at most
inline eprosima::fastrtps::rtps::HistoryAttributes history_attributes(const Endpoint& endpoint,
                                                                      std::size_t messages) {
  return {eprosima::fastrtps::rtps::DYNAMIC_RESERVE_MEMORY_MODE,
          static_cast<std::uint32_t>(endpoint.largest_message), 0,
          static_cast<std::int32_t>(messages)};
}

/// Whether an identifier is that of a reader, by its last byte: 4 or 7 in the lower bits.
inline bool is_reader(const eprosima::fastrtps::rtps::GUID_t& guid) {
  return (guid.entityId.value[3] & 0x04) != 0;
}

/// The bytes of a text, as USER_DATA has them.
inline std::vector<unsigned char> octets(const std::string& text) {
  return {text.begin(), text.end()};
}

/// Participants in a domain, and readers or writers of each, that are noted. Others are ignored.
inline constexpr std::size_t most_participants = 256;
inline constexpr std::size_t most_endpoints = 2048;
/// Peers' readers that match a writer here, and likewise: more than one participant has in a topic
/// that announces no false ends.
inline constexpr std::size_t most_matches = most_participants * KnownEndpoints::most_of_topic;

}  // namespace articula::ros2::dds
