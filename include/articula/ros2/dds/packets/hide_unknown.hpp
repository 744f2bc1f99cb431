// SPDX-License-Identifier: Apache-2.0
/// @file Messages of discovery without the parameters that nobody needs.
#pragma once

#include "articula/ros2/dds/packets/packet_check.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace articula::ros2::dds {

/// Turns unknown parameters of discovery into padding, which readers skip. Fast DDS 2.9.1 takes any
/// memory for some of them, as filters.
/// @param packet    well-formed
/// @param[out] copy  of the packet
/// Real-time: yes. O(size).
constexpr void hide_unknown(Packet packet, std::span<std::byte> copy) {
  for_each_part(packet, [&](std::uint32_t kind, std::uint32_t flags, Packet part) {
    constexpr std::uint32_t message = 0x15;
    if (kind != message) return true;
    const auto discovery = detail::discovery_of(part, flags);
    if (!discovery || !discovery->list) return true;
    return discovery->list->for_each([&](std::uint32_t, Packet value, detail::Worth worth) {
      if (worth != detail::Worth::unknown) return true;
      const auto id = static_cast<std::size_t>(value.data() - packet.data()) - 4;
      copy[id] = copy[id + 1] = std::byte{0};
      return true;
    });
  });
}

}  // namespace articula::ros2::dds
