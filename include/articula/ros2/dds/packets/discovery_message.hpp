// SPDX-License-Identifier: Apache-2.0
/// @file The messages by which participants announce themselves, their readers and their writers.
#pragma once

#include "articula/ros2/dds/packets/discovery_check.hpp"
#include "articula/ros2/dds/packets/packet_bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace articula::ros2::dds {

namespace detail {

/// Kinds of parts. Source: [RTPS], 9.4.5.
inline constexpr std::uint32_t acknowledgement_part = 0x06, heartbeat_part = 0x07, gap_part = 0x08,
                               source_part = 0x0c, destination_part = 0x0e,
                               fragments_missing_part = 0x12, fragments_heartbeat_part = 0x13,
                               message_part = 0x15, fragment_part = 0x16;

/// The writers of discovery: of participants, of writers, of readers. Source: [RTPS], table 9.2.
inline constexpr std::uint32_t participant_writer = 0x000100c2, writer_writer = 0x000003c2,
                               reader_writer = 0x000004c2;

/// The writer of a message or a fragment. Its fields are there.
constexpr std::uint32_t writer_of(Packet part) noexcept { return number_at(part, 8, 4, false); }
constexpr bool writes_endpoints(std::uint32_t writer) noexcept {
  return writer == writer_writer || writer == reader_writer;
}
constexpr bool writes_discovery(std::uint32_t writer) noexcept {
  return writer == participant_writer || writes_endpoints(writer);
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
  constexpr std::size_t most = 0x7fff;  // Fast DDS 2.9.1 takes more for a negative number
  const std::size_t behind = number_at(part, 2, 2, little), at = 4 + behind;
  if (behind > most || at < fields || at > part.size()) return std::nullopt;
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
  std::uint64_t number = 0;
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
  DiscoveryMessage message{
      .writer = writer_of(part), .number = sequence_at(part, 12, (flags & 1U) != 0), .body = *body};
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

/// Whether a message or a fragment of discovery announces something whole, in a message of its own.
/// If it has nothing but an identity, something ends. Others pass.
constexpr bool is_good_discovery(std::uint32_t kind, std::uint32_t flags, Packet part) noexcept {
  if (kind == fragment_part) return !writes_discovery(writer_of(part));
  const auto message = discovery_of(part, flags);
  if (!message) return true;
  if (part.size() > largest_discovery) return false;
  if (!message->list) return true;
  return message->list->is_whole() && (message->ends || !message->has_key_only);
}

}  // namespace detail

}  // namespace articula::ros2::dds
