// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/packets/checked_transport.hpp"

#include "articula/ros2/dds/packets/split_fragments.hpp"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/rtps/common/LocatorList.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <mutex>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace articula::ros2::dds {

namespace {

namespace transports = eprosima::fastdds::rtps;
namespace rtps = eprosima::fastrtps::rtps;

/// The time, in which this host may have slept: peers have not.
PacketGuard::Time now() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return PacketGuard::Time(std::chrono::seconds(time.tv_sec) +
                           std::chrono::nanoseconds(time.tv_nsec));
}

class CheckedTransport final : public transports::ChainingTransport {
 public:
  explicit CheckedTransport(const CheckedTransportDescriptor& descriptor)
      : ChainingTransport(descriptor), descriptor_(descriptor) {}

  transports::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }
  bool OpenInputChannel(const rtps::Locator_t& local,
                        transports::TransportReceiverInterface* receiver,
                        std::uint32_t longest) override {
    if (!ChainingTransport::OpenInputChannel(local, receiver, longest)) return false;
    if (!rtps::IPLocator::isMulticast(local)) descriptor_.guard().add_socket(local.port);
    return true;
  }
  bool OpenOutputChannel(transports::SendResourceList& resources,
                         const rtps::Locator_t& receiver) override {
    // Fast DDS 2.9.1 keeps each address for ever, and goes through all of them at each packet.
    constexpr std::size_t most = 1 << 15;  // more than the ports that a host gives its programs
    if (open_.size() >= most && !open_.contains(receiver)) return false;
    if (!ChainingTransport::OpenOutputChannel(resources, receiver)) return false;
    open_.insert(receiver);
    return true;
  }
  // Fast DDS 2.9.1 ends the program at a receiver for which it has opened nothing: the second of two
  // readers that share the address of a group. It holds one lock here and while it opens.
  bool send(rtps::SenderResource* below, const rtps::octet* bytes, std::uint32_t size,
            rtps::LocatorsIterator* first, rtps::LocatorsIterator* last,
            const std::chrono::steady_clock::time_point& deadline) override {
    std::vector<rtps::Locator_t> receivers;
    for (; *first != *last; ++*first) {
      if (open_.contains(**first) || OpenOutputChannel(unused_, **first)) {
        receivers.push_back(**first);
      }
    }
    transports::Locators begin(receivers.cbegin()), end(receivers.cend());
    const Packet packet = std::as_bytes(std::span(bytes, size));
    if (!PacketGuard::has_acknowledgement(packet)) {
      return below->send(bytes, size, &begin, &end, deadline);
    }
    std::vector<rtps::octet> own(bytes, bytes + size);
    descriptor_.guard().send(std::as_writable_bytes(std::span(own)));
    return below->send(own.data(), size, &begin, &end, deadline);
  }
  void receive(transports::TransportReceiverInterface* receiver, const rtps::octet* bytes,
               std::uint32_t size, const rtps::Locator_t& local,
               const rtps::Locator_t& remote) override {
    // Fast DDS 2.9.1 believes the first fragment of a message that the others are as long.
    constexpr std::size_t longest_fragment = 0xffff;
    const Packet raw = std::as_bytes(std::span(bytes, size));
    const auto split = split_fragments(raw);
    const Packet whole = split ? Packet(*split) : raw;
    std::vector<rtps::octet> own(whole.size() + longest_fragment);
    std::memcpy(own.data(), whole.data(), whole.size());
    const auto packet = std::as_writable_bytes(std::span(own)).first(whole.size());
    // Fast DDS 2.9.1 keeps participants for ever that come and go in two threads at a time.
    const std::lock_guard lock(receiving_);
    if (!descriptor_.guard().receive(packet, now())) return;
    // An announcement comes by this program's own ones, too. Whoever has left makes room first. Fast
    // DDS looks for participants at even ports ([RTPS], 9.6.1.1):
    // a farewell elsewhere would be lost.
    if (local.port % 2 == 0 && PacketGuard::has_announcement(packet)) {
      for (const std::vector<std::byte>& farewell : descriptor_.guard().farewells()) {
        std::vector<rtps::octet> end(farewell.size() + longest_fragment);
        std::memcpy(end.data(), farewell.data(), farewell.size());
        receiver->OnDataReceived(end.data(), static_cast<std::uint32_t>(farewell.size()), local,
                                 remote);
      }
    }
    receiver->OnDataReceived(own.data(), static_cast<std::uint32_t>(packet.size()), local, remote);
  }

 private:
  struct Before {  // kind, port, address
    bool operator()(const rtps::Locator_t& a, const rtps::Locator_t& b) const {
      const auto order = std::pair(a.kind, a.port) <=> std::pair(b.kind, b.port);
      return order != 0 ? order < 0 : std::memcmp(a.address, b.address, sizeof a.address) < 0;
    }
  };

  CheckedTransportDescriptor descriptor_;
  std::mutex receiving_{};
  std::set<rtps::Locator_t, Before> open_{};  // receivers
  transports::SendResourceList unused_{};     // sockets, since Fast DDS goes through its own ones
};

}  // namespace

transports::TransportInterface* CheckedTransportDescriptor::create_transport() const {
  return new CheckedTransport(*this);  // NOLINT(cppcoreguidelines-owning-memory): as documented
}

}  // namespace articula::ros2::dds
