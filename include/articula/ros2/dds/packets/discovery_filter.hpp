// SPDX-License-Identifier: Apache-2.0
/// @file Messages of discovery without what would harm Fast DDS.
#pragma once

#include "articula/ros2/dds/packets/packet_check.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace articula::ros2::dds {

namespace detail {

/// Turns a message or a fragment into a gap: its number will not come. So readers do not wait for
/// it, and messages after it arrive. Source: [RTPS], 9.4.5.2 and 9.4.5.5.
/// @param packet  with the part
/// @param part    can_be_gap
/// Real-time: yes.
constexpr void make_gap(std::span<std::byte> packet, std::uint32_t flags, Packet part) {
  const bool little = (flags & 1U) != 0;
  constexpr std::size_t ids_and_number = 16, end = 16, count = 24;  // [bytes]
  const std::uint64_t next = sequence_at(part, 12, little) + 1;
  const std::span<std::byte> own = mutable_part(packet, part);
  for (std::size_t k = 0; k < ids_and_number; ++k) own[k] = own[k + 4];
  put_sequence(own, end, little, next);
  for (std::size_t k = 0; k < 4; ++k) own[count + k] = std::byte{0};  // no further numbers
  put_head(packet, part, gap_part, flags);
}

}  // namespace detail

/// Turns unknown parameters of discovery into padding, which readers skip. Fast DDS 2.9.1 takes any
/// memory for some of them, as filters. Turns messages into gaps that are broken, large, or in
/// fragments, since nobody can check those before all are there.
/// @param[in,out] packet  well-formed
/// Real-time: yes. O(size).
constexpr void filter_discovery(std::span<std::byte> packet) {
  for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags, Packet part) {
    if (kind != detail::message_part && kind != detail::fragment_part) return true;
    if (!detail::is_good_discovery(kind, flags, part)) {
      detail::make_gap(packet, flags, part);
      return true;
    }
    const auto discovery =
        kind == detail::message_part ? detail::discovery_of(part, flags) : std::nullopt;
    if (!discovery || !discovery->list) return true;
    return discovery->list->for_each([&](std::uint32_t, Packet value, detail::Worth worth) {
      if (worth != detail::Worth::unknown) return true;
      const auto id = static_cast<std::size_t>(value.data() - packet.data()) - 4;
      packet[id] = packet[id + 1] = std::byte{0};
      return true;
    });
  });
}

}  // namespace articula::ros2::dds
