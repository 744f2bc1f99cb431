// SPDX-License-Identifier: Apache-2.0
/// @file A check that the parts of an RTPS packet are as long as they say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace articula::ros2::dds {

/// A packet of RTPS, or a part of one.
using Packet = std::span<const std::byte>;

/// The bytes of a packet before its parts.
inline constexpr std::size_t packet_header = 20;

namespace detail {

/// An unsigned number.
/// @param at      its place; the bytes are there
/// @param size    1, 2 or 4 bytes
/// @param little  the least significant byte comes first
constexpr std::uint32_t number_at(Packet bytes, std::size_t at, std::size_t size,
                                  bool little) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + (little ? size - 1 - i : i)]);
  }
  return value;
}

/// The length of a list of parameters with its end; 0 if it does not end within the bytes.
constexpr std::size_t parameters_size(Packet bytes, bool little) noexcept {
  constexpr std::uint32_t sentinel = 1;
  for (std::size_t at = 0; bytes.size() - at >= 4;) {
    const std::uint32_t id = number_at(bytes, at, 2, little);
    if (id == sentinel) return at + 4;
    const std::size_t size = number_at(bytes, at + 2, 2, little);
    if (size > bytes.size() - at - 4) return 0;
    at += 4 + size;
  }
  return 0;
}

/// A message or a fragment: its inline parameters and its payload begin within it.
/// @param fields    bytes before the inline parameters, at least
/// @param is_whole  it is no fragment
constexpr bool is_good_data(Packet part, std::uint32_t flags, std::size_t fields,
                            bool is_whole) noexcept {
  const bool little = (flags & 1U) != 0, has_parameters = (flags & 2U) != 0;
  if (part.size() < fields) return false;
  std::size_t at = 4 + number_at(part, 2, 2, little);
  if (at < fields || at > part.size()) return false;
  if (has_parameters) {
    const std::size_t size = parameters_size(part.subspan(at), little);
    if (size == 0) return false;
    at += size;
  }
  // Messages of discovery are lists of parameters themselves; a fragment ends anywhere in the list.
  const bool is_builtin = std::to_integer<unsigned>(part[11]) >= 0xc0;
  const Packet payload = part.subspan(at);
  if (!is_whole || !is_builtin || payload.size() < 4 ||
      (number_at(payload, 0, 2, false) & ~1U) != 2) {
    return true;
  }
  return parameters_size(payload.subspan(4), number_at(payload, 1, 1, false) == 3) > 0;
}

/// A set of sequence numbers: at most 256 bits, which are there.
/// @param at      place of the number of bits
/// @param behind  bytes that follow the set
constexpr bool is_good_set(Packet part, bool little, std::size_t at, std::size_t behind) noexcept {
  if (part.size() < at + 4) return false;
  const std::size_t bits = number_at(part, at, 4, little);
  return bits <= 256 && part.size() >= at + 4 + (bits + 31) / 32 * 4 + behind;
}

/// A part without its head of four bytes.
constexpr bool is_good_part(std::uint32_t kind, std::uint32_t flags, Packet part) noexcept {
  const bool little = (flags & 1U) != 0;
  switch (kind) {
    case 0x06:  // ACKNACK
      return is_good_set(part, little, 16, 4);
    case 0x07:  // HEARTBEAT
      return part.size() >= 28;
    case 0x08:  // GAP
      return is_good_set(part, little, 24, 0);
    case 0x09:  // INFO_TS
      return (flags & 2U) != 0 || part.size() >= 8;
    case 0x0c:  // INFO_SRC
      return part.size() >= 20;
    case 0x0e:  // INFO_DST
      return part.size() >= 12;
    case 0x12:  // NACK_FRAG
      return is_good_set(part, little, 20, 4);
    case 0x13:  // HEARTBEAT_FRAG
      return part.size() >= 24;
    case 0x15:  // DATA
      return is_good_data(part, flags, 20, true);
    case 0x16:  // DATA_FRAG: neither the number of fragments nor their size is 0
      return is_good_data(part, flags, 32, false) && number_at(part, 20, 4, little) > 0 &&
             number_at(part, 24, 2, little) > 0 && number_at(part, 26, 2, little) > 0;
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
    if (!function(kind, flags, packet.subspan(at, size))) return false;
    at += size;
  }
  return true;
}

/// Whether all parts of a packet are within it, and all that they contain is within them. Fast DDS
/// 2.9.1 reads beyond the end of some packets for which this is not so. Source: [RTPS], 9.4.
/// @param packet  as it came from the network
/// Real-time: yes. O(size).
[[nodiscard]] constexpr bool is_well_formed(Packet packet) noexcept {
  return packet.size() >= packet_header &&
         detail::number_at(packet, 0, 4, false) == 0x52545053 &&  // RTPS
         for_each_part(packet, detail::is_good_part);
}

}  // namespace articula::ros2::dds
