// SPDX-License-Identifier: Apache-2.0
/// @file Texts from outside, for terminals and logs.
#pragma once

#include "articula/text/characters.hpp"

#include <string>
#include <string_view>

namespace articula::view {

/// A text from outside that a terminal may print: control characters, which terminals obey, and
/// bytes that are not UTF-8 are question marks. White space around it is left out.
[[nodiscard]] inline std::string printable(std::string_view text) {
  std::string result;
  for (text = articula::detail::trimmed(text); !text.empty();) {
    const auto [bytes, code] = articula::detail::first_character(text);  // code 0: not UTF-8
    const bool is_control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    result += is_control ? "?" : bytes;
    text.remove_prefix(bytes.size());
  }
  return result;
}

}  // namespace articula::view
