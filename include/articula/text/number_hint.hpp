// SPDX-License-Identifier: Apache-2.0
/// @file The likely mistake in a text that should be a number.
#pragma once

#include "articula/text/characters.hpp"
#include "articula/text/numbers.hpp"
#include "articula/text/placeholder.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace articula::detail {

/// The number at the beginning of a text, such as 5 of "5 Nm"; empty if there is none.
[[nodiscard]] inline std::string_view leading_number(std::string_view text) {
  std::size_t size = std::min(text.find_first_not_of("0123456789.eE+-"), text.size());
  while (size > 0 && !number_of(text.substr(0, size))) --size;
  return text.substr(0, size);
}

/// How to correct a text that should be a number, for the end of a message; empty if that is not
/// known. It covers a decimal comma, a typographic minus sign, a unit, an expression.
[[nodiscard]] inline std::string number_hint(std::string_view text) {
  if (number_of(text) || has_placeholder(text) || !odd_character_in(text).empty()) return "";
  for (std::string_view rest = text; !rest.empty();) {
    const TextCharacter character = first_character(rest);
    rest.remove_prefix(character.bytes.size());
    if (character.bytes[0] >= 0) continue;
    constexpr std::u32string_view dashes = U"\u2010\u2013\u2212";
    if (dashes.find(character.code) != dashes.npos) return "; write an ordinary minus sign, -";
    return character.code == 0 ? "; a byte of it is not UTF-8"
                               : "; " + code_text(character.code) + " is no ASCII character";
  }
  std::string pointed(text);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  if (number_of(pointed) && !text.ends_with(',')) {
    return "; write " + shown(pointed) + " if the comma is a decimal one";
  }
  const bool is_term = text.find_first_of("*/()^") != std::string_view::npos &&
                       text.find_first_of("0123456789") != std::string_view::npos;
  if (is_term) return "; expressions are not computed";
  const std::string_view number = leading_number(text);
  const std::string_view rest = text.substr(number.size());
  if (number.empty() || rest.find_first_of("0123456789.+-") != rest.npos) return "";
  const bool is_unit = std::any_of(rest.begin(), rest.end(), [](char x) {
    return (x >= 'a' && x <= 'z') || (x >= 'A' && x <= 'Z');
  });
  return is_unit ? "; write a number in SI units, and no unit"
                 : "; write the number alone, " + shown(number);
}

}  // namespace articula::detail
