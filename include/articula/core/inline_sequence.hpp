// SPDX-License-Identifier: Apache-2.0
/// @file A sequence without heap memory.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace articula {

/// A sequence with room for `most` items and no heap memory.
/// Real-time: yes, if T's assignment is; likewise all functions of this class.
template <class T, std::size_t most>
class InlineSequence {
 public:
  static constexpr std::size_t capacity = most;

  /// Sets the number of items. New items are default values.
  /// @return false, and nothing is changed, if there is no room for them
  constexpr bool resize(std::size_t size) {
    if (size > capacity) return false;
    for (std::size_t i = size_; i < size; ++i) items_[i] = T();
    size_ = size;
    return true;
  }
  /// Appends an item.
  /// @return false, and nothing is changed, if there is no room for it
  constexpr bool push_back(const T& item) noexcept(std::is_nothrow_copy_assignable_v<T>) {
    if (size_ == capacity) return false;
    items_[size_++] = item;
    return true;
  }
  constexpr void clear() noexcept { size_ = 0; }

  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
  /// @pre i < size()
  [[nodiscard]] constexpr T& operator[](std::size_t i) noexcept { return items_[i]; }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const noexcept { return items_[i]; }
  /// @pre not empty
  [[nodiscard]] constexpr T& back() noexcept { return items_[size_ - 1]; }
  [[nodiscard]] constexpr T* begin() noexcept { return items_.data(); }
  [[nodiscard]] constexpr T* end() noexcept { return items_.data() + size_; }
  [[nodiscard]] constexpr const T* begin() const noexcept { return items_.data(); }
  [[nodiscard]] constexpr const T* end() const noexcept { return items_.data() + size_; }

 private:
  std::array<T, capacity> items_{};
  std::size_t size_ = 0;
};

}  // namespace articula
