// SPDX-License-Identifier: Apache-2.0
/// @file Numbers from and to text, the same in every locale.
#pragma once

#include "articula/core/finite.hpp"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace articula::detail {

/// The shortest text that reads back as the same double.
[[nodiscard]] inline std::string number_text(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

/// A number rounded to six digits.
[[nodiscard]] inline std::string rounded_text(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, 6).ptr};
}

/// The finite number that a text between white space is, or nothing.
[[nodiscard]] inline std::optional<double> number_of(std::string_view text) {
  constexpr std::string_view space = " \t\r\n";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(space) - first + 1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !is_finite(number)) {
    return std::nullopt;
  }
  return number;
}

}  // namespace articula::detail
