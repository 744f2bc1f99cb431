// SPDX-License-Identifier: Apache-2.0
/// @file A transport of Fast DDS with a guard.
#pragma once

#include "articula/ros2/dds/packets/packet_guard.hpp"

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <memory>
#include <utility>

namespace articula::ros2::dds {

/// Describes the transport, around another one.
class CheckedTransportDescriptor final
    : public eprosima::fastdds::rtps::ChainingTransportDescriptor {
 public:
  /// @param guard  of all packets to and from `below`
  CheckedTransportDescriptor(
      std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> below,
      std::shared_ptr<PacketGuard> guard)
      : ChainingTransportDescriptor(std::move(below)), guard_(std::move(guard)) {}

  /// Fast DDS owns it.
  [[nodiscard]] eprosima::fastdds::rtps::TransportInterface* create_transport() const override;
  [[nodiscard]] PacketGuard& guard() const noexcept { return *guard_; }

 private:
  std::shared_ptr<PacketGuard> guard_;
};

}  // namespace articula::ros2::dds
