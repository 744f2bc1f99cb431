// SPDX-License-Identifier: Apache-2.0
/// @file Characters of a text: those that cannot be seen, and texts as messages show them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace articula::detail {

inline constexpr std::string_view white_space = " \t\r\n";

/// A text without white space around it.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(white_space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

/// A character of a text in UTF-8.
struct TextCharacter {
  std::string_view bytes{};  ///< empty at the end of the text; one byte where it is not UTF-8
  char32_t code = 0;         ///< 0 where it is not UTF-8
};

[[nodiscard]] inline TextCharacter first_character(std::string_view text) {
  if (text.empty()) return {};
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t size = lead < 0x80             ? 1
                           : (lead & 0xe0) == 0xc0 ? 2
                           : (lead & 0xf0) == 0xe0 ? 3
                           : (lead & 0xf8) == 0xf0 ? 4
                                                   : 0;
  if (size == 0 || size > text.size()) return {text.substr(0, 1), 0};
  char32_t code = size == 1 ? lead : lead & (0x7fU >> size);
  for (std::size_t k = 1; k < size; ++k) {
    const auto next = static_cast<unsigned char>(text[k]);
    if ((next & 0xc0) != 0x80) return {text.substr(0, 1), 0};
    code = code << 6 | (next & 0x3fU);
  }
  return {text.substr(0, size), code};
}

/// The name of a character that looks like a blank or like nothing and that parsers take for a
/// letter; empty for any other. Text copied from web pages and word processors has such characters.
[[nodiscard]] inline std::string_view odd_name(char32_t code) {
  struct Range {
    char32_t first, last;
    std::string_view name;
  };
  static constexpr std::array<Range, 14> odd = {{{0x85, 0x85, "a next-line character"},
                                                 {0xa0, 0xa0, "a no-break space"},
                                                 {0xad, 0xad, "a soft hyphen"},
                                                 {0x1680, 0x1680, "an Ogham space"},
                                                 {0x2000, 0x200a, "a space of special width"},
                                                 {0x200b, 0x200b, "a zero-width space"},
                                                 {0x200c, 0x200d, "a zero-width joiner"},
                                                 {0x200e, 0x200f, "a direction mark"},
                                                 {0x2028, 0x2029, "a line separator"},
                                                 {0x202a, 0x202e, "a direction mark"},
                                                 {0x202f, 0x202f, "a narrow no-break space"},
                                                 {0x205f, 0x2064, "a space of special width"},
                                                 {0x3000, 0x3000, "an ideographic space"},
                                                 {0xfeff, 0xfeff, "a byte order mark"}}};
  const auto found = std::find_if(odd.begin(), odd.end(), [code](const Range& range) {
    return code >= range.first && code <= range.last;
  });
  return found == odd.end() ? std::string_view() : found->name;
}

/// U+00A0 or the like.
[[nodiscard]] inline std::string code_text(char32_t code) {
  std::string digits;
  for (; code != 0 || digits.size() < 4; code >>= 4) {
    digits.insert(digits.begin(), "0123456789ABCDEF"[code & 0xf]);
  }
  return "U+" + digits;
}

/// A number as manuals of fieldbuses write it, in hexadecimal digits, such as "06020000h".
/// @param digits  how many, 1 .. 8
/// Real-time: no (allocates).
[[nodiscard]] inline std::string hexadecimal(std::uint32_t number, int digits) {
  constexpr const char* all = "0123456789abcdef";
  std::string text;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) text += all[number >> shift & 0xf];
  return text + 'h';
}

/// The first odd character of a text as a message names it, "a no-break space (U+00A0)"; empty if
/// there is none.
[[nodiscard]] inline std::string odd_character_in(std::string_view text) {
  while (!text.empty()) {
    const TextCharacter character = first_character(text);
    const std::string_view name = odd_name(character.code);
    if (!name.empty()) return std::string(name) + " (" + code_text(character.code) + ")";
    text.remove_prefix(character.bytes.size());
  }
  return "";
}

/// A text from a file as a message shows it. It is short, on one line, without control characters,
/// and with the codes of characters that cannot be seen.
[[nodiscard]] inline std::string shown(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result;
  std::size_t taken = 0;
  while (taken < std::min(text.size(), longest)) {
    const TextCharacter character = first_character(text.substr(taken));
    taken += character.bytes.size();
    const auto first = static_cast<unsigned char>(character.bytes[0]);
    if (!odd_name(character.code).empty()) {
      result += "<" + code_text(character.code) + ">";
    } else {
      result += first < 0x20 || first == 0x7f ? "?" : character.bytes;
    }
  }
  return taken < text.size() ? result + "..." : result;
}

/// A text between quotation marks, and the first odd character in it.
[[nodiscard]] inline std::string quoted_text(std::string_view text) {
  const std::string odd = odd_character_in(text);
  return "'" + shown(text) + "'" + (odd.empty() ? "" : " with " + odd);
}

}  // namespace articula::detail
