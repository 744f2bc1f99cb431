// SPDX-License-Identifier: Apache-2.0
/// @file Error messages composed of texts and numbers.
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

/// A part of a message: a text, or a number with six digits, independent of the locale. It refers
/// to the text, so it is valid for the duration of a call. Lists of this one type avoid a template
/// for each combination of parts.
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
  MessagePart(bool) = delete;  ///< ambiguous: a number or a word
  MessagePart(char) = delete;  ///< likewise
  MessagePart(signed char) = delete;
  MessagePart(unsigned char) = delete;

  /// The text of the part.
  [[nodiscard]] std::string_view view() const noexcept {
    return size_ > 0 ? std::string_view(digits_.data(), size_) : text_;
  }

 private:
  void keep(const std::to_chars_result& written) noexcept {
    size_ = static_cast<std::size_t>(written.ptr - digits_.data());
  }

  std::string_view text_{};
  std::array<char, 24> digits_;  ///< of a number, at most 20 of them
  std::size_t size_ = 0;         ///< of the number; 0 for a text
};

using MessageParts = std::initializer_list<MessagePart>;

/// The concatenation of the parts. Real-time: no (allocates).
[[nodiscard, gnu::cold]] inline std::string message_of(MessageParts parts) {
  std::string message;
  for (const MessagePart& part : parts) message += part.view();
  return message;
}

/// Throws an error about an invalid value:
///
///     refuse({"period ", period, " s is not a positive number"});
///
/// @throws std::invalid_argument with the parts as its message
/// Real-time: no (throws).
[[noreturn, gnu::cold]] inline void refuse(MessageParts parts) {
  throw std::invalid_argument(message_of(parts));
}

}  // namespace articula::detail
