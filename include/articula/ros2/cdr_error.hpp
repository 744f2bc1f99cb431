// SPDX-License-Identifier: Apache-2.0
/// @file The errors of a message in CDR.
#pragma once

#include <cstdint>
#include <string_view>

namespace articula::ros2 {

/// Why a message was not encoded or decoded.
enum class CdrError : std::uint8_t {
  none,            ///< it was
  no_room,         ///< the bytes do not suffice for the message
  unknown_header,  ///< the first two bytes name another encoding than CDR
  bad_text,        ///< a text with a NUL in it, or one that does not end with NUL
  bad_bool,        ///< a bool that is neither 0 nor 1
  long_sequence,   ///< a sequence with more items than bytes, or than the struct has room for
  surplus,         ///< more than three bytes after the message
};

/// The error in words. Real-time: yes.
constexpr std::string_view text(CdrError error) noexcept {
  switch (error) {
    case CdrError::none:
      return "no error";
    case CdrError::no_room:
      return "the bytes end before the message";
    case CdrError::unknown_header:
      return "the bytes are not plain CDR";
    case CdrError::bad_text:
      return "a text has a NUL in it or none at its end";
    case CdrError::bad_bool:
      return "a bool is neither 0 nor 1";
    case CdrError::long_sequence:
      return "a sequence or text is too long";
    case CdrError::surplus:
      return "bytes follow the message";
  }
  return "unknown error";
}

}  // namespace articula::ros2
