// SPDX-License-Identifier: Apache-2.0
/// @file Sequences and texts of ROS messages that need no heap memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace articula::ros2 {

/// A sequence with room for `most` items and no heap memory.
template <class T, std::size_t most>
class InlineSequence {
 public:
  static constexpr std::size_t capacity = most;

  /// Sets the number of items. New items are default values.
  /// @return false, and nothing is changed, if there is no room for them
  /// Real-time: yes, if T's assignment is; likewise all functions of this class.
  constexpr bool resize(std::size_t size) {
    if (size > capacity) return false;
    for (std::size_t i = size_; i < size; ++i) items_[i] = T();
    size_ = size;
    return true;
  }
  /// Appends an item.
  /// @return false, and nothing is changed, if there is no room for it
  constexpr bool push_back(const T& item) {
    if (size_ == capacity) return false;
    items_[size_++] = item;
    return true;
  }

  [[nodiscard]] constexpr std::size_t size() const noexcept { return size_; }
  [[nodiscard]] constexpr bool empty() const noexcept { return size_ == 0; }
  /// @pre i < size()
  [[nodiscard]] constexpr T& operator[](std::size_t i) noexcept { return items_[i]; }
  [[nodiscard]] constexpr const T& operator[](std::size_t i) const noexcept { return items_[i]; }
  [[nodiscard]] constexpr T* begin() noexcept { return items_.data(); }
  [[nodiscard]] constexpr T* end() noexcept { return items_.data() + size_; }
  [[nodiscard]] constexpr const T* begin() const noexcept { return items_.data(); }
  [[nodiscard]] constexpr const T* end() const noexcept { return items_.data() + size_; }

 private:
  std::array<T, capacity> items_{};
  std::size_t size_ = 0;
};

/// The sequence that a .msg file writes as T[<=capacity]. The bound is part of the ROS type, in
/// contrast to that of `InlineSequence`.
template <class T, std::size_t capacity>
class BoundedSequence : public InlineSequence<T, capacity> {};

/// A text of at most `most` characters, without heap memory.
template <std::size_t most>
class InlineText {
 public:
  static constexpr std::size_t capacity = most;

  constexpr InlineText() = default;
  /// Takes the first `capacity` characters of the text. Real-time: yes; likewise all functions of
  /// this class.
  constexpr InlineText(std::string_view text)  // NOLINT: a text is a text
      : size_(std::min(text.size(), capacity)) {
    std::copy_n(text.begin(), size_, characters_.begin());
  }
  constexpr InlineText(const char* text)
      : InlineText(std::string_view(text)) {}  // NOLINT: likewise

  /// Replaces the text.
  /// @return false, and nothing is changed, if there is no room for it
  constexpr bool assign(std::string_view text) {
    if (text.size() > capacity) return false;
    *this = InlineText(text);
    return true;
  }
  [[nodiscard]] constexpr std::string_view view() const noexcept {
    return {characters_.data(), size_};
  }
  constexpr operator std::string_view() const noexcept { return view(); }  // NOLINT: likewise

 private:
  std::array<char, capacity> characters_{};
  std::size_t size_ = 0;
};

/// The text that a .msg file writes as string<=capacity. The bound is part of the ROS type.
template <std::size_t capacity>
class BoundedText : public InlineText<capacity> {
 public:
  using InlineText<capacity>::InlineText;
};

}  // namespace articula::ros2
