// SPDX-License-Identifier: Apache-2.0
/// @file Options of the transport over Fast DDS.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace articula::ros2 {

/// What `FastDdsTransport` is made with. The defaults keep to this host.
struct FastDdsOptions {
  unsigned domain = 0;  ///< ROS_DOMAIN_ID, 0 to 232
  /// IPv4 addresses of this host that are used. Loopback alone: no multicast. Any other one: also
  /// multicast there, by which ROS finds peers by default.
  std::vector<std::string> interfaces{"127.0.0.1"};
  /// IPv4 addresses whose first 32 participants get this one's announcement, beside multicast.
  std::vector<std::string> peers{"127.0.0.1"};
  bool shared_memory = false;             ///< also talk to peers on this host by shared memory
  std::size_t largest_message = 1 << 20;  ///< bytes of a message; larger ones are refused
  /// Replies that wait for the reader of their client, in number and for how long. ROS clients
  /// announce their reader at about the time of their first request.
  std::size_t waiting_replies = 64;
  std::chrono::milliseconds reply_patience{5000};
  /// Fast DDS writes what it finds wrong to the standard output. The setting is the process's.
  bool log = false;
};

}  // namespace articula::ros2
