// SPDX-License-Identifier: Apache-2.0
/// @file Names of links and joints, stored without heap memory.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula {

/// The name of a link or joint. It owns its text without heap memory. So robots known at compile
/// time and robots loaded at run time store names in the same way. It can be a template argument,
/// so that compilers print it in their messages; only for this its members are public.
class Name {
 public:
  static constexpr std::size_t capacity = 63;  ///< characters at most

  constexpr Name() = default;

  /// @param text  at most `capacity` characters, none of them NUL
  /// @throws std::length_error if the text is longer, std::invalid_argument if there is a NUL in it
  ///         (at compile time: does not compile)
  constexpr Name(std::string_view text) {  // NOLINT: a text is a name
    if (text.size() > capacity) {
      throw std::length_error("a name has at most 63 characters: " + std::string(text));
    }
    for (char c : text) {
      if (c == '\0') {
        throw std::invalid_argument("a name has no NUL in it: " + std::string(view()) + "\\0...");
      }
      characters[size++] = c;
    }
  }
  constexpr Name(const char* text) : Name(std::string_view(text)) {}         // NOLINT: likewise
  constexpr Name(const std::string& text) : Name(std::string_view(text)) {}  // NOLINT: likewise

  /// The text. Real-time: yes.
  [[nodiscard]] constexpr std::string_view view() const noexcept { return {characters, size}; }
  constexpr operator std::string_view() const noexcept { return view(); }  // NOLINT: see above

  [[nodiscard]] constexpr bool empty() const noexcept { return size == 0; }

  // These loops are faster at compile time than std::string_view, which calls functions for each
  // character. Comparison starts at the end, because names of one robot differ there.
  friend constexpr bool operator==(const Name& a, const Name& b) noexcept {
    if (a.size != b.size) return false;
    for (std::size_t i = a.size; i-- > 0;) {
      if (a.characters[i] != b.characters[i]) return false;
    }
    return true;
  }
  friend constexpr bool operator<(const Name& a, const Name& b) noexcept {
    std::size_t i = 0;  // the NUL at the end of the shorter one is less than any other character
    while (i < a.size && a.characters[i] == b.characters[i]) ++i;
    return static_cast<unsigned char>(a.characters[i]) <
           static_cast<unsigned char>(b.characters[i]);
  }

  /// Prints the text. Real-time: no (whatever the stream does).
  template <class Traits>
  friend std::basic_ostream<char, Traits>& operator<<(std::basic_ostream<char, Traits>& out,
                                                      const Name& name) {
    return out << name.view();
  }

  char characters[capacity + 1] = {};  // NOLINT: a plain array, which compilers print as text
  std::size_t size = 0;
};

}  // namespace articula
