// SPDX-License-Identifier: Apache-2.0
/// @file The object dictionary of a simulated CANopen node.
#pragma once

#include "articula/core/inline_sequence.hpp"
#include "articula/hardware/canopen/canopen.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace articula {

/// One object of a simulated node.
struct SimulatedObject {
  canopen::ObjectAddress address{};
  std::uint8_t size = 0;  ///< [bytes]
  bool writable = false;
  std::uint32_t value = 0;
};

/// The object dictionary of a simulated CANopen node: at most 128 objects of at most four bytes.
/// All functions are real-time and linear in the number of objects.
class SimulatedObjectDictionary {
 public:
  /// Adds an object with a new address.
  void add(const SimulatedObject& object) noexcept { objects_.push_back(object); }
  void clear() noexcept { objects_.clear(); }

  [[nodiscard]] const SimulatedObject* find(const canopen::ObjectAddress& address) const noexcept {
    const auto* const found = std::ranges::find(objects_, address, &SimulatedObject::address);
    return found == objects_.end() ? nullptr : found;
  }
  [[nodiscard]] SimulatedObject* find(const canopen::ObjectAddress& address) noexcept {
    return const_cast<SimulatedObject*>(std::as_const(*this).find(address));
  }
  /// The value of an object; 0 without it.
  [[nodiscard]] std::uint32_t value(const canopen::ObjectAddress& address) const noexcept {
    const SimulatedObject* const object = find(address);
    return object ? object->value : 0;
  }
  /// Sets the value of an object, if it is there.
  void set(const canopen::ObjectAddress& address, std::uint32_t value) noexcept {
    if (SimulatedObject* const object = find(address)) object->value = value;
  }

 private:
  InlineSequence<SimulatedObject, 128> objects_{};
};

}  // namespace articula
