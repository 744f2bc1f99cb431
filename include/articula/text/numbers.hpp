// SPDX-License-Identifier: Apache-2.0
/// @file Numbers from and to text, the same in every locale.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/text/characters.hpp"

#include <charconv>
#include <cstdlib>
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

/// The first word of a text, which is removed from the text; empty at its end.
[[nodiscard]] inline std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(white_space));
  text.remove_prefix(word.size());
  return word;
}

/// The finite number that a text holds, or nothing. White space around it is skipped.
[[nodiscard]] inline std::optional<double> number_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
#if defined(__cpp_lib_to_chars)
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
#else  // the C++ library of WebAssembly, which knows one locale only
  const std::string copy(text);
  char* stop = nullptr;
  number = std::strtod(copy.c_str(), &stop);
  const bool is_empty = copy.empty() || white_space.find(copy[0]) != white_space.npos;
  const auto error = is_empty || stop == copy.c_str() ? std::errc::invalid_argument : std::errc{};
  const char* const end = text.data() + (stop - copy.c_str());
#endif
  if (error != std::errc{} || end != text.data() + text.size() || !is_finite(number)) {
    return std::nullopt;
  }
  return number;
}

}  // namespace articula::detail
