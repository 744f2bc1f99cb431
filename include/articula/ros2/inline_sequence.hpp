// SPDX-License-Identifier: Apache-2.0
/// @file Sequences and texts of ROS messages that need no heap memory.
#pragma once

#include "articula/core/inline_sequence.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace articula::ros2 {

using articula::InlineSequence;

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
