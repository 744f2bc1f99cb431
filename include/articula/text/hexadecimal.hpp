// SPDX-License-Identifier: Apache-2.0
/// @file Numbers as manuals of fieldbuses write them.
#pragma once

#include <cstdint>
#include <string>

namespace articula::detail {

/// A number in hexadecimal digits, such as "06020000h".
/// @param digits  how many, 1 .. 8
/// Real-time: no (allocates).
[[nodiscard]] inline std::string hexadecimal(std::uint32_t number, int digits) {
  constexpr const char* all = "0123456789abcdef";
  std::string text;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) text += all[number >> shift & 0xf];
  return text + 'h';
}

}  // namespace articula::detail
