// SPDX-License-Identifier: Apache-2.0
/// @file Configured values for objects of a CANopen node.
#pragma once

#include "articula/core/inline_sequence.hpp"
#include "articula/core/refuse.hpp"
#include "articula/hardware/can/object_address.hpp"

#include <cstdint>
#include <initializer_list>

namespace articula::canopen {

/// A value for an object: `{{0x6072, 0}, 1500, 2}` sets object 6072h,0, of two bytes, to 1500.
struct ObjectValue {
  ObjectAddress address{};
  std::uint32_t value = 0;  ///< negative numbers as two's complement
  std::uint8_t size = 0;    ///< [bytes], 1 .. 4, from the node's manual
};

/// At most 24 values, in the order of writing.
class ObjectValues : private InlineSequence<ObjectValue, 24> {
 public:
  using InlineSequence::begin, InlineSequence::end, InlineSequence::size;

  constexpr ObjectValues() = default;
  /// @throws std::invalid_argument if there are more than 24, or a size is not 1 .. 4; a constant
  ///         expression does not compile then
  /// Real-time: no (throws).
  constexpr ObjectValues(std::initializer_list<ObjectValue> values) {
    if (values.size() > capacity) {
      articula::detail::refuse(
          {"CANopen: ", values.size(), " objects are more than ", capacity, ", the most per node"});
    }
    for (const ObjectValue& value : values) {
      if (value.size < 1 || value.size > 4) {
        articula::detail::refuse({"CANopen: object ", to_string(value.address), ": size ",
                                  int{value.size}, " is not within 1 .. 4 bytes"});
      }
      push_back(value);
    }
  }
};

}  // namespace articula::canopen
