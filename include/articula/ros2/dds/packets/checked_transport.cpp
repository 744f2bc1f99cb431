// SPDX-License-Identifier: Apache-2.0
#include "articula/ros2/dds/packets/checked_transport.hpp"

#include "articula/ros2/dds/packets/discovery_filter.hpp"
#include "articula/ros2/dds/packets/packet_check.hpp"
#include "articula/ros2/dds/packets/participant_gate.hpp"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>

#include <chrono>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace articula::ros2::dds {

namespace {

namespace transports = eprosima::fastdds::rtps;
namespace rtps = eprosima::fastrtps::rtps;

class CheckedTransport final : public transports::ChainingTransport {
 public:
  explicit CheckedTransport(const CheckedTransportDescriptor& descriptor)
      : ChainingTransport(descriptor), descriptor_(descriptor) {}

  transports::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }
  bool send(rtps::SenderResource* below, const rtps::octet* bytes, std::uint32_t size,
            rtps::LocatorsIterator* first, rtps::LocatorsIterator* last,
            const std::chrono::steady_clock::time_point& deadline) override {
    return below->send(bytes, size, first, last, deadline);
  }
  void receive(transports::TransportReceiverInterface* receiver, const rtps::octet* bytes,
               std::uint32_t size, const rtps::Locator_t& local,
               const rtps::Locator_t& remote) override {
    const Packet packet = std::as_bytes(std::span(bytes, size));
    if (!is_well_formed(packet)) return;
    std::vector<rtps::octet> filtered(bytes, bytes + size);
    const auto own = std::as_writable_bytes(std::span(filtered));
    filter_discovery(own);
    if (gate_admits(own)) receiver->OnDataReceived(filtered.data(), size, local, remote);
  }

 private:
  /// Each port has a thread that receives.
  bool gate_admits(std::span<std::byte> packet) {
    const std::lock_guard lock(mutex_);
    return gate_.admits(packet, std::chrono::steady_clock::now());
  }

  CheckedTransportDescriptor descriptor_;
  std::mutex mutex_{};
  ParticipantGate gate_{};
};

}  // namespace

transports::TransportInterface* CheckedTransportDescriptor::create_transport() const {
  return new CheckedTransport(*this);  // NOLINT(cppcoreguidelines-owning-memory): as documented
}

}  // namespace articula::ros2::dds
