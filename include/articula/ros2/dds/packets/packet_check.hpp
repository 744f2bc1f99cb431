// SPDX-License-Identifier: Apache-2.0
/// @file A check that the parts of an RTPS packet are as long as they say.
#pragma once

#include "articula/ros2/dds/packets/discovery_check.hpp"
#include "articula/ros2/dds/packets/packet_bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace articula::ros2::dds {

/// The bytes of a packet before its parts.
inline constexpr std::size_t packet_header = 20;

namespace detail {

/// The writers of discovery: of participants, of writers, of readers. Source: [RTPS], table 9.2.
inline constexpr std::uint32_t participant_writer = 0x000100c2, writer_writer = 0x000003c2,
                               reader_writer = 0x000004c2;

/// The writer of a message or a fragment. Its fields are there.
constexpr std::uint32_t writer_of(Packet part) noexcept { return number_at(part, 8, 4, false); }
constexpr bool writes_discovery(std::uint32_t writer) noexcept {
  return writer == participant_writer || writer == writer_writer || writer == reader_writer;
}
/// Whether a writer is one of DDS itself. Source: [RTPS], 9.3.1.2.
constexpr bool is_builtin(std::uint32_t writer) noexcept { return (writer & 0xc0U) == 0xc0U; }

/// The bytes of a message of discovery. Those of ROS have some hundred, and Fast DDS 2.9.1 keeps
/// all that come out of order.
inline constexpr std::size_t largest_discovery = 8192;

/// The inline parameters of a message or a fragment, and what follows them.
struct Body {
  ParameterList inline_list{};
  bool has_inline_list = false;
  Packet payload{};
};

/// Splits a message or a fragment.
/// @param fields  bytes before the inline parameters, at least
/// @return        nothing if the payload does not begin within it
constexpr std::optional<Body> body_of(Packet part, std::uint32_t flags,
                                      std::size_t fields) noexcept {
  const bool little = (flags & 1U) != 0, has_parameters = (flags & 2U) != 0;
  if (part.size() < fields) return std::nullopt;
  const std::size_t at = 4 + number_at(part, 2, 2, little);
  if (at < fields || at > part.size()) return std::nullopt;
  const Packet rest = part.subspan(at);
  if (!has_parameters) return Body{.payload = rest};
  const std::size_t size =
      for_each_parameter(rest, little, [](std::uint32_t, Packet) { return true; });
  if (size == 0) return std::nullopt;
  return Body{{rest.first(size), little}, true, rest.subspan(size)};
}

/// A message of discovery.
struct DiscoveryMessage {
  std::uint32_t writer = 0;
  Body body{};
  std::optional<ParameterList> list{};  ///< what it announces, or the identity of what ends
  bool ends = false;                    ///< what it names leaves
  bool has_key_only = false;
};

/// Reads a message of discovery.
/// @param part  a message whose payload begins within it
/// @return      nothing if it is of something else
constexpr std::optional<DiscoveryMessage> discovery_of(Packet part, std::uint32_t flags) noexcept {
  if (!writes_discovery(writer_of(part))) return std::nullopt;
  const auto body = body_of(part, flags, 20);
  if (!body) return std::nullopt;
  DiscoveryMessage message{.writer = writer_of(part), .body = *body};
  if (body->has_inline_list) {
    message.body.inline_list.for_each([&](std::uint32_t id, Packet value, Worth) {
      constexpr std::uint32_t status = 0x71;  // 1: disposed, 2: unregistered, 3: both
      if (id == status && value.size() == 4) {
        const std::uint32_t own = number_at(value, 0, 4, false);
        message.ends = own >= 1 && own <= 3;
      }
      return true;
    });
  }
  const bool has_data = (flags & 4U) != 0, has_key = (flags & 8U) != 0;
  message.has_key_only = has_key && !has_data;
  if (!has_data && !has_key) return message;
  message.list.emplace();  // which does not end
  if (body->payload.size() < 4) return message;
  const std::uint32_t encoding = number_at(body->payload, 0, 2, false);
  if (encoding == 2 || encoding == 3) *message.list = {body->payload.subspan(4), encoding == 3};
  return message;
}

/// A message: its payload begins within it. One of discovery announces something whole. If it has
/// nothing but an identity, something ends.
constexpr bool is_good_message(Packet part, std::uint32_t flags) noexcept {
  if (!body_of(part, flags, 20)) return false;
  const auto message = discovery_of(part, flags);
  if (message && part.size() > largest_discovery) return false;
  if (!message || !message->list) return true;
  return message->list->is_whole() && (message->ends || !message->has_key_only);
}

/// A fragment: its payload begins within it. Fragments of DDS itself are refused, since nobody can
/// check them before all are there.
constexpr bool is_good_fragment(Packet part, std::uint32_t flags) noexcept {
  return body_of(part, flags, 32) && !is_builtin(writer_of(part));
}

/// A set of sequence numbers: at most 256 bits, which are there.
/// @param at      place of the number of bits
/// @param behind  bytes that follow the set
constexpr bool is_good_set(Packet part, bool little, std::size_t at, std::size_t behind) noexcept {
  if (part.size() < at + 4) return false;
  const std::size_t bits = number_at(part, at, 4, little);
  return bits <= 256 && part.size() >= at + 4 + (bits + 31) / 32 * 4 + behind;
}

/// A sequence number: its upper half comes first.
constexpr std::uint64_t sequence_at(Packet part, std::size_t at, bool little) noexcept {
  return std::uint64_t{number_at(part, at, 4, little)} << 32 | number_at(part, at + 4, 4, little);
}

/// A gap: numbers of messages that will not come. Fast DDS 2.9.1 notes each of them.
constexpr bool is_good_gap(Packet part, bool little) noexcept {
  if (!is_good_set(part, little, 24, 0)) return false;
  const std::uint64_t first = sequence_at(part, 8, little), end = sequence_at(part, 16, little);
  constexpr std::uint64_t most_of_builtin = 1 << 12, most = 1 << 20;
  const bool builtin = is_builtin(number_at(part, 4, 4, false));
  return end < first || end - first <= (builtin ? most_of_builtin : most);
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
      return is_good_gap(part, little);
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
      return is_good_message(part, flags);
    case 0x16:  // DATA_FRAG: neither the number of fragments nor their size is 0
      return is_good_fragment(part, flags) && number_at(part, 20, 4, little) > 0 &&
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
