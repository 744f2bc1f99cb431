// SPDX-License-Identifier: Apache-2.0
/// @file An array without initial values, one element for each body.
#pragma once

#include "articula/core/joint_array.hpp"

#include <memory>
#include <type_traits>

namespace articula::detail {

/// Storage for elements that an algorithm sets one by one. A plain array of vectors would be filled
/// with zeros first, which takes up to a fifth of the time of a model's inverse dynamics.
/// @tparam T  with a trivial destructor
/// @tparam N  number of elements
template <class T, int N>
class UnsetArray {
 public:
  /// @pre element i has been set
  [[nodiscard, gnu::always_inline]] constexpr T& operator[](int i) noexcept {
    return slots_[i].element;
  }
  [[gnu::always_inline]] constexpr void set(int i, const T& value) noexcept {
    std::construct_at(&slots_[i].element, value);
  }

 private:
  union Slot {
    constexpr Slot() noexcept {}  // NOLINT: without the element
    constexpr Slot(const Slot&) noexcept
      requires std::is_trivially_copyable_v<T>
    = default;
    constexpr Slot(const Slot& other) noexcept : element(other.element) {}
    T element;
  };

  JointArray<Slot, N> slots_;
};

}  // namespace articula::detail
