// SPDX-License-Identifier: Apache-2.0
/// @file The numbers and the lists of parameters in a packet of RTPS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace articula::ros2::dds {

/// A packet of RTPS, or a part of one.
using Packet = std::span<const std::byte>;

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

/// A sequence number: its upper half comes first. Source: [RTPS], 9.3.2.
constexpr std::uint64_t sequence_at(Packet bytes, std::size_t at, bool little) noexcept {
  return std::uint64_t{number_at(bytes, at, 4, little)} << 32 | number_at(bytes, at + 4, 4, little);
}
/// Writes a sequence number.
constexpr void put_sequence(std::span<std::byte> bytes, std::size_t at, bool little,
                            std::uint64_t value) noexcept {
  for (std::size_t k = 0; k < 8; ++k) {
    const std::size_t significance = (k < 4 ? 4 : 0) + (little ? k % 4 : 3 - k % 4);
    bytes[at + k] = static_cast<std::byte>(value >> (8 * significance) & 0xffU);
  }
}
/// A part of a packet that may be changed.
constexpr std::span<std::byte> mutable_part(std::span<std::byte> packet, Packet part) noexcept {
  return packet.subspan(static_cast<std::size_t>(part.data() - packet.data()), part.size());
}
/// Changes the kind and the size of a part, behind its head of four bytes.
constexpr void put_head(std::span<std::byte> packet, Packet part, std::uint32_t kind,
                        std::uint32_t flags) noexcept {
  const std::size_t head = static_cast<std::size_t>(part.data() - packet.data()) - 4;
  const std::size_t low = (flags & 1U) != 0 ? 2 : 3;
  packet[head] = static_cast<std::byte>(kind);
  packet[head + 1] = static_cast<std::byte>(flags & 1U);
  packet[head + low] = static_cast<std::byte>(part.size() & 0xffU);
  packet[head + 5 - low] = static_cast<std::byte>(part.size() >> 8U);
}
/// Turns a part into padding, which readers skip. Source: [RTPS], 9.4.5.14.
constexpr void hide_part(std::span<std::byte> packet, Packet part, std::uint32_t flags) noexcept {
  constexpr std::uint32_t padding = 0x01;
  put_head(packet, part, padding, flags);
}

/// Calls function(id, value) for each of a list of parameters, which returns whether it is good.
/// @return the length of the list with its end; 0 if it does not end within the bytes, a parameter
///         is not good, or one does not end at a multiple of four ([RTPS], 9.4.2.11)
constexpr std::size_t for_each_parameter(Packet bytes, bool little, auto&& function) {
  constexpr std::uint32_t sentinel = 1;
  for (std::size_t at = 0; bytes.size() - at >= 4;) {
    const std::uint32_t id = number_at(bytes, at, 2, little);
    if (id == sentinel) return at + 4;
    const std::size_t size = number_at(bytes, at + 2, 2, little);
    if (size % 4 != 0 || size > bytes.size() - at - 4) return 0;
    if (!function(id, bytes.subspan(at + 4, size))) return 0;
    at += 4 + size;
  }
  return 0;
}

}  // namespace detail

}  // namespace articula::ros2::dds
