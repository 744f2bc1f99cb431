// SPDX-License-Identifier: Apache-2.0
/// @file The graph of nodes with their readers and writers, as ROS tools ask for it.
#pragma once

#include "articula/ros2/layout.hpp"

#include <fastdds/rtps/common/Guid.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace articula::ros2::dds {

/// The topic by which participants tell each other their nodes.
inline constexpr std::string_view discovery_info_topic = "ros_discovery_info";
inline constexpr std::string_view discovery_info_type =
    "rmw_dds_common/msg/ParticipantEntitiesInfo";

/// The nodes of a participant.
class Graph {
 public:
  using Guid = eprosima::fastrtps::rtps::GUID_t;

  /// Adds a reader or writer, and its node.
  /// @param node  full name
  void add(const std::string& node, const Guid& endpoint);
  /// Removes a reader or writer. Its node stays.
  void remove(const Guid& endpoint);

  /// The message of the topic above.
  /// @param participant  whose nodes these are
  [[nodiscard]] std::vector<std::byte> message(Distribution distribution,
                                               const Guid& participant) const;

 private:
  struct Node {
    std::vector<Guid> readers{};
    std::vector<Guid> writers{};
  };
  std::map<std::string, Node> nodes_{};
};

/// The hash of that message's type; empty for Humble.
std::string discovery_info_hash(Distribution distribution);

}  // namespace articula::ros2::dds
