// SPDX-License-Identifier: Apache-2.0
/// @file The desired configuration of a process data object of a CANopen node.
#pragma once

#include "articula/hardware/canopen/canopen_pdo_mapping.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace articula::canopen {

/// The desired configuration of one process data object (PDO), and the addresses of its objects
/// [CiA 301, 7.5.2.35 to 38].
struct PdoTask {
  enum class Direction : unsigned char { receive, transmit };
  struct Entry {
    MappedObject object{};
    bool required = true;  ///< Else the PDO may lack it, if the node cannot map it.
  };

  Direction direction = Direction::receive;
  std::uint8_t number = 0;  ///< 0 for PDO 1
  std::uint8_t node = 0;
  bool may_map = true;         ///< Else the mapping is only read.
  std::uint16_t deadline = 0;  ///< of an RPDO [ms]; 0: none
  std::array<Entry, 5> entries{};
  std::size_t entry_count = 0;

  /// Adds an object; at most five. Real-time: yes.
  constexpr void add(const MappedObject& object, bool required) noexcept {
    entries[entry_count++] = {object, required};
  }

  [[nodiscard]] constexpr bool is_receive() const noexcept {
    return direction == Direction::receive;
  }
  /// The address of a communication parameter. Real-time: yes.
  [[nodiscard]] constexpr ObjectAddress parameter(std::uint8_t subindex) const noexcept {
    return {static_cast<std::uint16_t>((is_receive() ? 0x1400 : 0x1800) + number), subindex};
  }
  /// The address of an entry of the mapping, or with 0 of their number. Real-time: yes.
  [[nodiscard]] constexpr ObjectAddress mapping(std::size_t subindex) const noexcept {
    return {static_cast<std::uint16_t>(parameter(0).index + 0x200),
            static_cast<std::uint8_t>(subindex)};
  }
  /// The predefined identifier. Real-time: yes.
  [[nodiscard]] constexpr std::uint32_t identifier() const noexcept {
    return (is_receive() ? receive_pdo_1_base : transmit_pdo_1_base) + pdo_spacing * number + node;
  }
  /// Whether a transmission type is synchronous: 0 .. 240 puts an RPDO into force at SYNC, and 1
  /// sends a TPDO at each SYNC. Real-time: yes.
  [[nodiscard]] constexpr bool is_synchronous(std::uint32_t type) const noexcept {
    return is_receive() ? type <= 240 : type == 1;
  }
};

}  // namespace articula::canopen
