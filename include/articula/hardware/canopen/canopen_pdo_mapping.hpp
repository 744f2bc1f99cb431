// SPDX-License-Identifier: Apache-2.0
/// @file The mapping of a process data object: its objects and their positions in the frame.
#pragma once

#include "articula/core/inline_sequence.hpp"
#include "articula/hardware/canopen/canopen.hpp"

#include <cstdint>

namespace articula::canopen {

/// One object in a process data object.
struct MappedObject {
  ObjectAddress address{};
  std::uint8_t bits = 0;

  /// The entry of a mapping object: index, subindex, bits [CiA 301, 7.5.2.36].
  [[nodiscard]] constexpr std::uint32_t entry() const noexcept {
    return std::uint32_t{address.index} << 16 | std::uint32_t{address.subindex} << 8 | bits;
  }
  [[nodiscard]] static constexpr MappedObject of_entry(std::uint32_t entry) noexcept {
    return {{static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8 & 0xff)},
            static_cast<std::uint8_t>(entry & 0xff)};
  }
  friend constexpr bool operator==(const MappedObject&, const MappedObject&) = default;
};

/// The objects of a process data object, in their order: at most eight, of whole bytes.
class PdoMapping : private InlineSequence<MappedObject, 8> {
 public:
  using InlineSequence::begin, InlineSequence::capacity, InlineSequence::clear,
      InlineSequence::empty, InlineSequence::end, InlineSequence::size;
  static constexpr std::uint8_t absent = 0xff;

  /// Adds an object at the end. Real-time: yes.
  /// @return false if the frame is full or the bits are not whole bytes
  constexpr bool push_back(const MappedObject& object) noexcept {
    const bool fits = object.bits != 0 && object.bits % 8 == 0 && length() + object.bits / 8U <= 8;
    return fits && InlineSequence::push_back(object);
  }

  /// Length of the frame [bytes]. Real-time: yes.
  [[nodiscard]] constexpr std::uint8_t length() const noexcept {
    unsigned bits = 0;
    for (const MappedObject& object : *this) bits += object.bits;
    return static_cast<std::uint8_t>(bits / 8);
  }
  /// First byte of an object in the frame; `absent` without that object. Real-time: yes.
  [[nodiscard]] constexpr std::uint8_t offset_of(const MappedObject& wanted) const noexcept {
    unsigned bits = 0;
    for (const MappedObject& object : *this) {
      if (object == wanted) return static_cast<std::uint8_t>(bits / 8);
      bits += object.bits;
    }
    return absent;
  }
  [[nodiscard]] constexpr bool contains(const MappedObject& wanted) const noexcept {
    return offset_of(wanted) != absent;
  }
};

}  // namespace articula::canopen
