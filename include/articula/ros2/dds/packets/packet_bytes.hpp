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
