// SPDX-License-Identifier: Apache-2.0
/// @file An array whose elements get their values later.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

namespace articula::detail {

/// Room for elements that an algorithm sets one by one. An array of vectors, which are zero unless
/// something else is said, would be filled with zeros first: that takes up to a fifth of a model's
/// inverse dynamics.
/// @tparam T  with a trivial destructor
template <class T, int Size>
class UnsetArray {
 public:
  /// The elements that have been set may be read and changed.
  [[nodiscard, gnu::always_inline]] constexpr T& operator[](std::size_t i) noexcept {
    return rooms_[i].element;
  }
  [[gnu::always_inline]] constexpr void set(std::size_t i, const T& value) noexcept {
    std::construct_at(&rooms_[i].element, value);
  }

 private:
  union Room {
    constexpr Room() noexcept {}  // NOLINT: without the element
    T element;
  };

  std::array<Room, static_cast<std::size_t>(Size)> rooms_;
};

}  // namespace articula::detail
