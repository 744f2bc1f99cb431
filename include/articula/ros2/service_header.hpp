// SPDX-License-Identifier: Apache-2.0
/// @file The headers that match replies to requests, in the two dialects of ROS 2.
#pragma once

#include "articula/ros2/fields.hpp"

#include <array>
#include <cstdint>

namespace articula::ros2 {

/// A request or reply as rmw_cyclonedds sends it: client and number of the request precede the ROS
/// message. The reply repeats both.
template <Message M>
struct CycloneMessage {
  std::uint64_t client = 0;   ///< the client's writer
  std::int64_t sequence = 0;  ///< number of the request
  M message{};

  static constexpr TypeName ros_type = M::ros_type;
  static constexpr FieldNames<3> ros_fields{"client", "sequence", "message"};
};

/// What rmw_fastrtps sends beside a request or reply, as an RTPS parameter of 24 bytes. A request
/// has the reader that waits for its reply. A reply has that reader and the number of the request.
struct RelatedSampleIdentity {
  /// Numbers of the parameter: of Humble and of DDS-RPC. Jazzy's clients read and write both.
  static constexpr std::uint16_t humble_parameter = 0x800f, standard_parameter = 0x0083;

  std::array<std::uint8_t, 16> reader{};  ///< its identifier in DDS
  std::int32_t sequence_high = 0;         ///< number of the request, its upper half
  std::uint32_t sequence_low = 0;         ///< its lower half
};

/// The number of the request as one number. Real-time: yes.
constexpr std::int64_t sequence(const RelatedSampleIdentity& identity) noexcept {
  return static_cast<std::int64_t>(identity.sequence_high) * (std::int64_t{1} << 32) +
         static_cast<std::int64_t>(identity.sequence_low);
}

/// The identity of a request's number. Real-time: yes.
/// @param reader    that waits for the reply
/// @param sequence  number of the request
constexpr RelatedSampleIdentity related_sample_identity(const std::array<std::uint8_t, 16>& reader,
                                                        std::int64_t sequence) noexcept {
  return {reader, static_cast<std::int32_t>(sequence >> 32),
          static_cast<std::uint32_t>(sequence & 0xffffffff)};
}

}  // namespace articula::ros2
