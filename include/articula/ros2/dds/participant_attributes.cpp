// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/participant_attributes.hpp"

#include "articula/core/refuse.hpp"
#include "articula/ros2/dds/endpoints/endpoint.hpp"
#include "articula/ros2/dds/packets/checked_transport.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPFinder.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace articula::ros2::dds {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

constexpr unsigned last_domain = 232;                   // later ones have no UDP ports
constexpr const char* discovery_group = "239.255.0.1";  // of all DDS, by its standard
constexpr std::uint32_t discovery_port = 7400, ports_of_a_domain = 250;
// Participants on a host take successive ports. ROS looks for as many.
constexpr std::uint32_t participants_of_a_peer = 32;
// The system may allow less (net.core.rmem_max), of which Linux makes twice as much.
constexpr std::uint32_t wanted_receive_buffer = 1 << 22;  // bytes
constexpr std::size_t least_message = 1024, largest_message = std::size_t{1} << 30;

bool is_loopback(const std::string& address) { return address.starts_with("127."); }

std::vector<std::string> addresses_of_this_host() {
  std::vector<rtps::IPFinder::info_IP> found;
  rtps::IPFinder::getIPs(&found, true);
  std::vector<std::string> addresses;
  for (const auto& address : found) {
    if (address.type == rtps::IPFinder::IP4 || address.type == rtps::IPFinder::IP4_LOCAL) {
      addresses.push_back(address.name);
    }
  }
  return addresses;
}

rtps::Locator_t locator(const std::string& address, std::uint32_t port) {
  rtps::Locator_t result;
  result.kind = LOCATOR_KIND_UDPv4;
  rtps::IPLocator::setIPv4(result, address);
  result.port = port;
  return result;
}

}  // namespace

void check(const FastDdsOptions& options) {
  using articula::detail::refuse;
  if (options.domain > last_domain) {
    refuse({"ros2: FastDdsOptions::domain is ", options.domain, "; expected 0 to ", last_domain});
  }
  if (options.interfaces.empty()) refuse({"ros2: FastDdsOptions::interfaces is empty"});
  const std::vector<std::string> own = addresses_of_this_host();
  for (const std::string& address : options.interfaces) {
    if (std::find(own.begin(), own.end(), address) != own.end()) continue;
    std::string all;
    for (const std::string& other : own) all += " " + other;
    refuse({"ros2: FastDdsOptions::interfaces has '", address,
            "'; expected IPv4 addresses of this host:", all});
  }
  for (const std::string& address : options.peers) {
    if (!rtps::IPLocator::isIPv4(address)) {
      refuse({"ros2: FastDdsOptions::peers has '", address,
              "'; expected IPv4 addresses, as \"192.168.0.7\""});
    }
  }
  if (options.largest_message < least_message || options.largest_message > largest_message) {
    refuse({"ros2: FastDdsOptions::largest_message is ", options.largest_message, "; expected ",
            least_message, " to ", largest_message});
  }
  if (options.reply_patience.count() < 0) {
    refuse({"ros2: FastDdsOptions::reply_patience is ", options.reply_patience.count(),
            " ms; expected at least 0"});
  }
}

rtps::RTPSParticipantAttributes participant_attributes(const FastDdsOptions& options,
                                                       const std::shared_ptr<PacketGuard>& guard) {
  rtps::RTPSParticipantAttributes attributes;
  attributes.setName("articula");
  attributes.userData = octets("enclave=/;");

  attributes.useBuiltinTransports = false;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = options.interfaces;
  udp->maxInitialPeersRange = participants_of_a_peer;
  udp->non_blocking_send = true;  // what is lost is sent again
  udp->receiveBufferSize = wanted_receive_buffer;
  attributes.userTransports.push_back(std::make_shared<CheckedTransportDescriptor>(udp, guard));
  if (options.shared_memory) {
    attributes.userTransports.push_back(
        std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>());
  }

  auto& builtin = attributes.builtin;
  builtin.discovery_config.leaseDuration = {ParticipantGate::own_lease.count(), 0};
  for (const std::string& peer : options.peers) {
    builtin.initialPeersList.push_back(locator(peer, 0));  // port 0: all participants of the peer
  }
  if (std::all_of(options.interfaces.begin(), options.interfaces.end(), is_loopback)) {
    // With a unicast address given, Fast DDS adds no multicast one. Port 0 is that of the domain.
    for (const std::string& address : options.interfaces) {
      builtin.metatrafficUnicastLocatorList.push_back(locator(address, 0));
    }
  } else {
    builtin.initialPeersList.push_back(
        locator(discovery_group, discovery_port + ports_of_a_domain * options.domain));
  }

  attributes.allocation.participants = {0, most_participants, 1};
  attributes.allocation.readers = {0, most_endpoints, 1};
  attributes.allocation.writers = {0, most_endpoints, 1};
  return attributes;
}

}  // namespace articula::ros2::dds
