// SPDX-License-Identifier: Apache-2.0
/// @file A transport of Fast DDS that drops packets which would harm it.
#pragma once

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

namespace articula::ros2::dds {

/// Describes the transport, around another one. See `is_well_formed` and ParticipantGate.
struct CheckedTransportDescriptor final
    : public eprosima::fastdds::rtps::ChainingTransportDescriptor {
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  /// Fast DDS owns it.
  [[nodiscard]] eprosima::fastdds::rtps::TransportInterface* create_transport() const override;
};

}  // namespace articula::ros2::dds
