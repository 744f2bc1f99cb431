// SPDX-License-Identifier: Apache-2.0
/// @file The object dictionary of a simulated CANopen node.
#pragma once

#include "articula/hardware/canopen/canopen.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace articula {

/// One object of a simulated node.
struct SimulatedCanopenObject {
  canopen::ObjectAddress address{};
  std::uint8_t size = 0;  ///< [bytes]
  bool writable = false;
  std::uint32_t value = 0;
};

/// The object dictionary of a simulated CANopen node: up to 128 objects of at most four bytes.
class SimulatedCanopenObjects {
 public:
  static constexpr std::size_t capacity = 128;

  /// Adds an object at an address where there is none. Real-time: yes.
  void add(const SimulatedCanopenObject& object) noexcept {
    if (size_ < capacity) objects_[size_++] = object;
  }
  void clear() noexcept { size_ = 0; }

  /// Real-time: yes. O(objects).
  [[nodiscard]] SimulatedCanopenObject* find(const canopen::ObjectAddress& address) noexcept {
    const auto end = objects_.begin() + static_cast<std::ptrdiff_t>(size_);
    const auto at =
        std::find_if(objects_.begin(), end, [&](const auto& o) { return o.address == address; });
    return at == end ? nullptr : &*at;
  }
  [[nodiscard]] const SimulatedCanopenObject* find(
      const canopen::ObjectAddress& address) const noexcept {
    return const_cast<SimulatedCanopenObjects*>(this)->find(address);
  }
  /// The value of an object; 0 if there is none. Real-time: yes. O(objects).
  [[nodiscard]] std::uint32_t value(const canopen::ObjectAddress& address) const noexcept {
    const SimulatedCanopenObject* const object = find(address);
    return object ? object->value : 0;
  }
  /// Gives an object a value, if there is one. Real-time: yes. O(objects).
  void set(const canopen::ObjectAddress& address, std::uint32_t value) noexcept {
    if (SimulatedCanopenObject* const object = find(address)) object->value = value;
  }

 private:
  std::array<SimulatedCanopenObject, capacity> objects_{};
  std::size_t size_ = 0;
};

}  // namespace articula
