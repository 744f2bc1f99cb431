// SPDX-License-Identifier: Apache-2.0
/// @file What people write where YAML wants a number.
#pragma once

#include "articula/config/yaml/odd_character.hpp"
#include "articula/config/yaml/placeholder.hpp"
#include "articula/config/yaml/scalar.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace articula::detail {

/// The numbers that a text may have meant that has commas, or marks between thousands; empty where
/// it cannot be read so.
struct NumberReadings {
  std::string decimal{};  ///< if a comma stands for the decimal point
  std::string grouped{};  ///< if there are marks between thousands

  /// What to write instead; empty if nothing is known.
  [[nodiscard]] std::string advice() const {
    if (decimal.empty() && grouped.empty()) return "";
    if (grouped.empty()) return "a decimal point, " + shown(decimal);
    if (decimal.empty()) return "no marks between thousands, " + shown(grouped);
    return shown(grouped) + " if the comma stands between thousands, " + shown(decimal) +
           " if it is a decimal comma";
  }
};

/// The text without marks between its thousands, if it has such: 1,234.5 or 1.234,5 or 1'234 or
/// 1_234 or 1 234; empty otherwise. A single point is no mark.
[[nodiscard]] inline std::string without_marks(std::string_view text) {
  constexpr std::string_view digits = "0123456789";
  std::string result;
  if (text.starts_with('-') || text.starts_with('+')) {
    result = text.substr(0, 1);
    text.remove_prefix(1);
  }
  const auto count = [&] { return std::min(text.find_first_not_of(digits), text.size()); };
  std::size_t size = count();
  if (size < 1 || size > 3 || text[0] == '0' || size == text.size()) return "";
  const char mark = text[size];
  if (std::string_view(",.'_ ").find(mark) == std::string_view::npos) return "";
  result += text.substr(0, size);
  text.remove_prefix(size);
  std::size_t groups = 0;
  for (; text.starts_with(mark); ++groups) {
    text.remove_prefix(1);
    size = count();
    if (size != 3) return "";
    result += text.substr(0, size);
    text.remove_prefix(size);
  }
  const char point = mark == '.' ? ',' : '.';
  const bool has_point = text.starts_with(point);
  if (mark == '.' && groups < 2 && !has_point) return "";
  if (has_point) {
    result += '.';
    result += text.substr(1);
  } else if (!text.empty()) {
    return "";
  }
  return parse_number(result).is_number ? result : "";
}

[[nodiscard]] inline NumberReadings readings_of(std::string_view text) {
  NumberReadings readings{.grouped = without_marks(text)};
  std::string pointed(text);
  const std::size_t comma = pointed.find(',');
  if (comma == std::string::npos || comma + 1 == text.size()) return readings;
  pointed[comma] = '.';
  if (parse_number(pointed).is_number) readings.decimal = pointed;
  return readings;
}

/// The number at which a text begins, such as that of "5 Nm"; empty if there is none.
[[nodiscard]] inline std::string_view leading_number(std::string_view text) {
  std::size_t size = std::min(text.find_first_not_of("0123456789.eE+-"), text.size());
  while (size > 0 && !parse_number(text.substr(0, size)).is_number) --size;
  return text.substr(0, size);
}

/// What is likely to be wrong with a text that is to be a number, to be said behind what was
/// expected; empty if that is not known.
[[nodiscard]] inline std::string number_hint(std::string_view text) {
  if (parse_number(text).is_number) return "";  // but not of the kind or size that is wanted
  if (has_placeholder(text) || !odd_character_in(text).empty()) return "";  // what_is says it
  for (const char* dash : {"\xE2\x88\x92", "\xE2\x80\x93", "\xE2\x80\x90"}) {
    if (text.find(dash) != std::string_view::npos) return " with an ordinary minus sign, -";
  }
  const NumberReadings readings = readings_of(text);
  if (!readings.advice().empty()) {
    const bool both = !readings.decimal.empty() && !readings.grouped.empty();
    return (both ? ": " : " with ") + readings.advice();
  }
  for (std::string_view rest = text; !rest.empty();) {
    const TextCharacter character = first_character(rest);
    if (character.bytes[0] < 0)
      return " of the digits 0 to 9, where there is " +
             (character.code == 0 ? "a byte that is no UTF-8" : code_text(character.code));
    rest.remove_prefix(character.bytes.size());
  }
  std::string_view size = text;
  if (size.starts_with('-') || size.starts_with('+')) size.remove_prefix(1);
  if (is_one_of(size, {"inf", "infinity"})) return "; infinity is .inf";
  const bool is_term = text.find_first_of("*/()^") != std::string_view::npos &&
                       text.find_first_of("0123456789") != std::string_view::npos;
  if (is_term || is_one_of(size, {"pi"})) {
    return "; nothing is computed in YAML";
  }
  const std::string_view number = leading_number(text), rest = text.substr(number.size());
  const bool is_unit = !number.empty() && rest.find_first_of("0123456789.+-") == rest.npos;
  return is_unit ? " and nothing behind it, " + shown(number) : "";
}

}  // namespace articula::detail
