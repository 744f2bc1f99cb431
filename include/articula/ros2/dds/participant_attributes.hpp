// SPDX-License-Identifier: Apache-2.0
/// @file The options of a participant in the terms of Fast DDS.
#pragma once

#include "articula/ros2/dds/fast_dds_options.hpp"
#include "articula/ros2/dds/packets/packet_guard.hpp"

#include <fastdds/rtps/attributes/RTPSParticipantAttributes.h>

#include <memory>

namespace articula::ros2::dds {

/// Checks the options.
/// @throws std::invalid_argument with the option, its value and what is expected
void check(const FastDdsOptions& options);

/// Where a participant is heard, whom it tells about itself, and how many others it notes.
/// @param options  checked ones
/// @param guard    of its packets
eprosima::fastrtps::rtps::RTPSParticipantAttributes participant_attributes(
    const FastDdsOptions& options, const std::shared_ptr<PacketGuard>& guard);

}  // namespace articula::ros2::dds
