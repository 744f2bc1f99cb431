// SPDX-License-Identifier: Apache-2.0
/// @file The object dictionary of a simulated CANopen node.
#pragma once

#include "articula/hardware/canopen/canopen.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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
  void add(const SimulatedObject& object) noexcept {
    if (size_ < objects_.size()) objects_[size_++] = object;
  }
  void clear() noexcept { size_ = 0; }

  [[nodiscard]] const SimulatedObject* find(const canopen::ObjectAddress& address) const noexcept {
    const auto used = std::span(objects_).first(size_);
    const auto found = std::ranges::find(used, address, &SimulatedObject::address);
    return found == used.end() ? nullptr : &*found;
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
  std::array<SimulatedObject, 128> objects_{};
  std::size_t size_ = 0;
};

}  // namespace articula
