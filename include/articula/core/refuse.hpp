// SPDX-License-Identifier: Apache-2.0
/// @file How what makes no sense is refused: with a message put together from texts and numbers.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace articula::detail {

/// A part of a message: a text, or a number as streams write it unless told otherwise (six digits,
/// whatever the locale). A text is referred to, so a part lasts for the length of a call.
/// Where messages are made there is then a list of one type, and no template for each combination
/// of parts.
class MessagePart {
 public:
  MessagePart(std::string_view text) noexcept : text_(text) {}    // NOLINT: a text is a part
  MessagePart(const char* text) noexcept : text_(text) {}         // NOLINT: likewise
  MessagePart(const std::string& text) noexcept : text_(text) {}  // NOLINT: likewise

  [[gnu::cold]] MessagePart(double number) noexcept {  // NOLINT: a number is a part
    keep(std::to_chars(digits_.data(), digits_.data() + digits_.size(), number,
                       std::chars_format::general, 6));
  }
  template <std::integral Number>
  [[gnu::cold]] MessagePart(Number number) noexcept {  // NOLINT: likewise
    using Widest = std::conditional_t<std::signed_integral<Number>, long long, unsigned long long>;
    keep(std::to_chars(digits_.data(), digits_.data() + digits_.size(),
                       static_cast<Widest>(number)));
  }
  MessagePart(bool) = delete;  ///< a number or a word?
  MessagePart(char) = delete;  ///< likewise
  MessagePart(signed char) = delete;
  MessagePart(unsigned char) = delete;

  /// What it says.
  [[nodiscard]] std::string_view view() const noexcept {
    return size_ > 0 ? std::string_view(digits_.data(), size_) : text_;
  }

 private:
  void keep(const std::to_chars_result& written) noexcept {
    size_ = static_cast<std::size_t>(written.ptr - digits_.data());
  }

  std::string_view text_{};
  std::array<char, 24> digits_;  ///< of a number, at most 20 of them
  std::size_t size_ = 0;         ///< of the number; 0: it is a text
};

using MessageParts = std::initializer_list<MessagePart>;

/// The parts, one after another. Real-time: no (allocates).
[[nodiscard, gnu::cold]] inline std::string message_of(MessageParts parts) {
  std::string message;
  for (const MessagePart& part : parts) message += part.view();
  return message;
}

/// Refuses what makes no sense:
///
///     refuse({"period ", period, " s is not a positive number"});
///
/// @throws std::invalid_argument with the parts as its message
/// Real-time: no (throws).
[[noreturn, gnu::cold]] inline void refuse(MessageParts parts) {
  throw std::invalid_argument(message_of(parts));
}

}  // namespace articula::detail
