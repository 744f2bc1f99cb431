// SPDX-License-Identifier: Apache-2.0
/// @file A CAN frame as a value, and integers in its payload.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace articula {

/// A classical CAN data frame [ISO 11898-1]. Remote frames and CAN FD are not used.
struct CanFrame {
  std::uint32_t identifier = 0;        ///< 11 bits, or 29 if extended; a lower one has priority
  bool extended = false;               ///< the identifier has 29 bits
  std::uint8_t length = 0;             ///< bytes of data, 0 .. 8
  std::array<std::uint8_t, 8> data{};  ///< payload; bytes beyond `length` are 0

  friend constexpr bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// Whether identifier and length are within their ranges. Real-time: yes.
[[nodiscard]] constexpr bool is_valid(const CanFrame& frame) noexcept {
  return frame.identifier < (frame.extended ? 1U << 29 : 1U << 11) && frame.length <= 8;
}

/// The node number of a frame whose identifier is a base plus a node number of 1 .. `last`; 0 for
/// another frame. Real-time: yes.
[[nodiscard]] constexpr std::uint8_t node_after(std::uint32_t base, std::uint8_t last,
                                                const CanFrame& frame) noexcept {
  const bool is = !frame.extended && frame.identifier > base && frame.identifier <= base + last;
  return is ? static_cast<std::uint8_t>(frame.identifier - base) : std::uint8_t{0};
}

/// The longest length of a frame on the bus [bit], with stuff bits and interframe space. It is g +
/// 8 n + 13 + floor((g + 8 n - 1) / 4), where n is `length` and g is 34, or 54 if extended [Davis
/// et al. 2007, eq. 1]. Divided by the bit rate, it is the longest time on the bus.
/// Real-time: yes.
[[nodiscard]] constexpr int worst_case_bits(const CanFrame& frame) noexcept {
  const int stuffed = (frame.extended ? 54 : 34) + 8 * frame.length;
  return stuffed + 13 + (stuffed - 1) / 4;
}

/// Reads an integer from a payload, least significant byte first.
/// @tparam T       type of the result; signed types are sign-extended
/// @tparam Offset  first byte
/// @tparam Bytes   number of bytes
/// Real-time: yes.
template <class T, std::size_t Offset, std::size_t Bytes = sizeof(T)>
[[nodiscard]] constexpr T load_little_endian(const std::array<std::uint8_t, 8>& data) noexcept {
  static_assert(Bytes <= sizeof(T) && Bytes <= 4 && Offset + Bytes <= 8);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < Bytes; ++i) bits |= std::uint32_t{data[Offset + i]} << (8 * i);
  constexpr std::uint32_t sign = std::uint32_t{1} << (8 * Bytes - 1);
  if constexpr (T(-1) < T(0)) {
    // Unsigned arithmetic does not overflow.
    const std::uint32_t extended = (bits ^ sign) - sign;
    return static_cast<T>(static_cast<std::int32_t>(extended));
  } else {
    return static_cast<T>(bits);
  }
}

/// Reads an integer with the size of its type from a byte that is known at run time.
/// @param offset  first byte; the integer must end within the payload
/// Real-time: yes.
template <class T>
[[nodiscard]] T load_little_endian(const std::array<std::uint8_t, 8>& data,
                                   std::size_t offset) noexcept {
  std::array<std::uint8_t, sizeof(T)> bytes;
  std::memcpy(bytes.data(), data.data() + offset, sizeof(T));
  if constexpr (std::endian::native != std::endian::little) std::ranges::reverse(bytes);
  return std::bit_cast<T>(bytes);
}

/// Writes an integer with the size of its type from a byte that is known at run time on.
/// @param offset  first byte; the integer must end within the payload
/// Real-time: yes.
template <class T>
void store_little_endian(std::array<std::uint8_t, 8>& data, std::size_t offset, T value) noexcept {
  auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
  if constexpr (std::endian::native != std::endian::little) std::ranges::reverse(bytes);
  std::memcpy(data.data() + offset, bytes.data(), sizeof(T));
}

/// Writes the low bytes of an integer into a payload, least significant byte first.
/// @tparam Offset  first byte
/// @tparam Bytes   number of bytes
/// Real-time: yes.
template <std::size_t Offset, std::size_t Bytes, class T>
constexpr void store_little_endian(std::array<std::uint8_t, 8>& data, T value) noexcept {
  static_assert(Bytes <= 4 && Offset + Bytes <= 8);
  const auto bits = static_cast<std::uint32_t>(value);
  for (std::size_t i = 0; i < Bytes; ++i) {
    data[Offset + i] = static_cast<std::uint8_t>(bits >> (8 * i) & 0xff);
  }
}

}  // namespace articula
