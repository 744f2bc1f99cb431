// SPDX-License-Identifier: Apache-2.0
/// @file A check of the parameters in a message of discovery.
#pragma once

#include "articula/ros2/dds/packets/packet_bytes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace articula::ros2::dds::detail {

/// Takes a text or some bytes off, which begin with their length and end at a multiple of four.
/// @return whether they are there
constexpr bool take_text(Packet& bytes, bool little) noexcept {
  if (bytes.size() < 4) return false;
  const std::size_t length = number_at(bytes, 0, 4, little), left = bytes.size() - 4;
  if (length > left) return false;
  bytes = bytes.subspan(4 + std::min((length + 3) / 4 * 4, left));
  return true;
}

/// Whether the bytes are one text, or some bytes with their length.
constexpr bool is_text(Packet bytes, bool little) noexcept {
  return take_text(bytes, little) && bytes.empty();
}

/// Whether the bytes are a number and so many texts.
constexpr bool has_texts(Packet bytes, bool little) noexcept {
  if (bytes.size() < 4) return false;
  const std::size_t count = number_at(bytes, 0, 4, little);
  bytes = bytes.subspan(4);
  if (count > bytes.size() / 4) return false;
  for (std::size_t k = 0; k < count; ++k) {
    if (!take_text(bytes, little)) return false;
  }
  return bytes.empty();
}

/// The size of a parameter that always has the same one; 0 for others. Source: [RTPS], tables 9.13
/// and 9.14.
constexpr std::size_t fixed_size(std::uint32_t id) noexcept {
  switch (id) {
    case 0x06:  // strength of ownership
    case 0x0f:  // domain
    case 0x15:  // version of the protocol
    case 0x16:  // vendor
    case 0x1d:  // durability
    case 0x1f:  // ownership
    case 0x25:  // destination order
    case 0x43:  // expects inline parameters
    case 0x44:  // builtin endpoints
    case 0x49:  // transport priority
    case 0x53:  // group
    case 0x58:  // builtin endpoints
    case 0x60:  // size of the type
    case 0x77:  // quality of builtin endpoints
      return 4;
    case 0x02:  // lease
    case 0x04:  // time filter
    case 0x21:  // presentation
    case 0x23:  // deadline
    case 0x27:  // latency budget
    case 0x2b:  // lifespan
    case 0x40:  // history
      return 8;
    case 0x1a:  // reliability
    case 0x1b:  // liveliness
    case 0x41:  // limits of resources
      return 12;
    case 0x50:  // identity of a participant,
    case 0x52:  // of a group,
    case 0x5a:  // of an endpoint
      return 16;
    case 0x2f:  // addresses
    case 0x30:
    case 0x31:
    case 0x32:
    case 0x33:
    case 0x48:
      return 24;
    case 0x1e:  // durability service
      return 28;
    default:
      return 0;
  }
}

inline constexpr std::size_t longest_name = 256;     ///< with its length [bytes]
inline constexpr std::uint32_t longest_lease = 300;  ///< of a participant [s]; ROS has 10 or 20

/// What a parameter of discovery is worth.
enum class Worth : unsigned char {
  whole,    ///< It contains what it says.
  broken,   ///< It does not, or Fast DDS 2.9.1 keeps the message for ever.
  unknown,  ///< It has another size, or nobody here needs it, as filters, properties, security.
};

/// Judges a parameter of discovery.
constexpr Worth worth_of(std::uint32_t id, Packet value, bool little) noexcept {
  const auto judged = [](bool is_whole) { return is_whole ? Worth::whole : Worth::broken; };
  switch (id) {
    case 0x05:  // name of a topic
    case 0x07:  // name of a type
    case 0x62:  // name of an entity
      return judged(value.size() <= longest_name && is_text(value, little));
    case 0x2c:  // data of a user,
    case 0x2d:  // of a group,
    case 0x2e:  // of a topic
      return judged(is_text(value, little));
    case 0x29:  // partitions
      return judged(has_texts(value, little));
    case 0x73:  // representations of data, of two bytes each
      return judged(value.size() >= 4 && number_at(value, 0, 4, little) <= (value.size() - 4) / 2);
    default:
      return value.size() == fixed_size(id) && !value.empty() ? Worth::whole : Worth::unknown;
  }
}

/// A list of parameters and its byte order.
struct ParameterList {
  Packet bytes{};
  bool little = false;

  /// As for_each_parameter, with worth_of each.
  /// @return whether the list ends, and the function always returned true
  constexpr bool for_each(auto&& function) const {
    return for_each_parameter(bytes, little, [&](std::uint32_t id, Packet value) {
             return function(id, value, worth_of(id, value, little));
           }) > 0;
  }
  /// Whether it ends and no parameter is broken. Fast DDS 2.9.1 takes gigabytes for some that are.
  [[nodiscard]] constexpr bool is_whole() const {
    return for_each([](std::uint32_t, Packet, Worth worth) { return worth != Worth::broken; });
  }
};

}  // namespace articula::ros2::dds::detail
