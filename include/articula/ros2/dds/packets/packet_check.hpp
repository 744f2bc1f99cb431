// SPDX-License-Identifier: Apache-2.0
/// @file A check that the parts of an RTPS packet are as long as they say.
#pragma once

#include "articula/ros2/dds/packets/discovery_message.hpp"
#include "articula/ros2/dds/packets/packet_bytes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace articula::ros2::dds {

/// The bytes of a packet before its parts.
inline constexpr std::size_t packet_header = 20;

namespace detail {

/// Whether a message or a fragment can become a gap.
constexpr bool can_be_gap(Packet part) noexcept { return part.size() >= 28; }

/// Whether a part has a possible sequence number at a place, as no writer reaches more. Fast DDS
/// 2.9.1 ends the program for the number after the largest one.
constexpr bool has_number(Packet part, bool little, std::size_t at) noexcept {
  return sequence_at(part, at, little) < std::uint64_t{1} << 62;
}

/// A fragment of a message that has several, alone in its part, and with all its bytes. Fast DDS
/// 2.9.1 reads beyond the part for those that lack bytes. It frees what it does not own for empty
/// ones, and uses freed memory for those of a key or of a whole message. It hangs for tiny ones,
/// between which it keeps a list.
constexpr bool is_good_fragment(std::uint32_t flags, Packet part) noexcept {
  constexpr std::uint32_t has_key = 4, least = 64;  // bytes
  const bool little = (flags & 1U) != 0;
  const auto body = body_of(part, flags, 32);
  if (!body || (flags & has_key) != 0) return false;
  const std::uint64_t number = number_at(part, 20, 4, little),
                      size = number_at(part, 26, 2, little), total = number_at(part, 28, 4, little);
  if (number == 0 || number_at(part, 24, 2, little) != 1 || size < least) return false;
  const std::uint64_t begin = (number - 1) * size;
  return size < total && begin < total && body->payload.size() >= std::min(size, total - begin);
}

/// A message or a fragment: its payload begins within it. One of discovery that is not good can
/// become a gap, except that of a participant. Fragments of the rest of DDS itself are refused.
constexpr bool is_good_message(std::uint32_t kind, std::uint32_t flags, Packet part) noexcept {
  if (!body_of(part, flags, kind == fragment_part ? 32 : 20)) return false;
  if (!has_number(part, (flags & 1U) != 0, 12)) return false;
  const std::uint32_t writer = writer_of(part);
  if (kind == fragment_part && is_builtin(writer) && !writes_discovery(writer)) return false;
  if (is_good_discovery(kind, flags, part)) return true;
  return writer != participant_writer && can_be_gap(part);
}

/// A set of sequence numbers: at most 256 bits, which are there.
/// @param at      place of the number of bits
/// @param behind  bytes that follow the set
constexpr bool is_good_set(Packet part, bool little, std::size_t at, std::size_t behind) noexcept {
  if (part.size() < at + 4) return false;
  const std::size_t bits = number_at(part, at, 4, little);
  return bits <= 256 && part.size() >= at + 4 + (bits + 31) / 32 * 4 + behind;
}

/// Whether a set of fragments, which is there, has possible numbers. There is no fragment 0: Fast
/// DDS 2.9.1 reads before the message for it, or sends it for ever.
constexpr bool has_fragments(Packet part, bool little) noexcept {
  constexpr std::uint32_t most = 0xffff'ffff - 256;
  const std::uint32_t first = number_at(part, 16, 4, little);
  return first >= 1 && first <= most;
}

/// A part without its head of four bytes.
constexpr bool is_good_part(std::uint32_t kind, std::uint32_t flags, Packet part) noexcept {
  const bool little = (flags & 1U) != 0;
  switch (kind) {
    case acknowledgement_part:
      return is_good_set(part, little, 16, 4) && has_number(part, little, 8);
    case heartbeat_part:
      return part.size() >= 28 && has_number(part, little, 8) && has_number(part, little, 16);
    case gap_part:
      return is_good_set(part, little, 24, 0) && has_number(part, little, 8) &&
             has_number(part, little, 16);
    case 0x09:  // time
      return (flags & 2U) != 0 || part.size() >= 8;
    case source_part:
      return part.size() >= 20;
    case destination_part:
      return part.size() >= 12;
    case fragments_missing_part:
      return is_good_set(part, little, 20, 4) && has_number(part, little, 8) &&
             has_fragments(part, little);
    case fragments_heartbeat_part:
      return part.size() >= 24 && has_number(part, little, 8);
    case message_part:
      return is_good_message(kind, flags, part);
    case fragment_part:
      return is_good_message(kind, flags, part) &&
             (writes_discovery(writer_of(part)) || is_good_fragment(flags, part));
    default:
      return true;  // Unknown parts are skipped.
  }
}

}  // namespace detail

/// Calls function(kind, flags, part) for the parts of a packet, in their order. The part is without
/// its head of four bytes. Ends where the function returns false.
/// @param packet  with a whole header
/// @return        whether all parts are within the packet, and the function always returned true
/// Real-time: yes, if the function is. O(number of parts).
constexpr bool for_each_part(Packet packet, auto&& function) {
  for (std::size_t at = packet_header; at < packet.size();) {
    if (packet.size() - at < 4) return false;
    const std::uint32_t kind = detail::number_at(packet, at, 1, false),
                        flags = detail::number_at(packet, at + 1, 1, false);
    std::size_t size = detail::number_at(packet, at + 2, 2, (flags & 1U) != 0);
    at += 4;
    // The last part may leave its length out, except those that may be empty.
    if (size == 0 && kind != 0x01 && kind != 0x09) size = packet.size() - at;
    if (size > packet.size() - at) return false;
    if (size % 4 != 0 && size < packet.size() - at) return false;  // [RTPS], 9.4.1
    if (!function(kind, flags, packet.subspan(at, size))) return false;
    at += size;
  }
  return true;
}

/// Whether all parts of a packet are within it, and all that they contain is within them. Fast DDS
/// 2.9.1 reads beyond the end of some packets for which this is not so. It ends the program if its
/// own part of statistics is not the last one. It takes gigabytes for some lengths in messages of
/// discovery. Source: [RTPS], 9.4.
/// @param packet  as it came from the network
/// Real-time: yes. O(size).
[[nodiscard]] constexpr bool is_well_formed(Packet packet) noexcept {
  if (packet.size() < packet_header) return false;
  if (detail::number_at(packet, 0, 4, false) != 0x52545053) return false;  // RTPS
  bool ended = false;
  return for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags, Packet part) {
    constexpr std::uint32_t statistics = 0x80;
    if (ended) return false;
    ended = kind == statistics;
    return detail::is_good_part(kind, flags, part);
  });
}

}  // namespace articula::ros2::dds
