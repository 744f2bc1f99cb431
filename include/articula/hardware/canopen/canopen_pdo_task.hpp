// SPDX-License-Identifier: Apache-2.0
/// @file What a process data object of a CANopen node is to be.
#pragma once

#include "articula/hardware/canopen/canopen_pdo_mapping.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace articula::canopen {

/// What one process data object (PDO) is to be.
struct PdoTask {
  enum class Direction : unsigned char { receive, transmit };
  struct Wish {
    MappedObject object{};
    bool required = true;  ///< Else the PDO does without it, if the node cannot map it.
  };
  static constexpr std::size_t most_wishes = 5;

  Direction direction = Direction::receive;
  std::uint8_t number = 0;  ///< 0 for PDO 1
  std::uint8_t node = 0;
  bool may_map = true;         ///< Else the mapping is only read.
  std::uint16_t deadline = 0;  ///< of an RPDO [ms]; 0: none
  std::array<Wish, most_wishes> wishes{};
  std::size_t wish_count = 0;

  /// Adds an object; at most `most_wishes`.
  constexpr void wish(const MappedObject& object, bool required) noexcept {
    wishes[wish_count++] = {object, required};
  }
};

}  // namespace articula::canopen
