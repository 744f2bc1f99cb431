// SPDX-License-Identifier: Apache-2.0
/// @file JSON from clients and to them.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace articula::view {

using Json = nlohmann::json;

/// The deepest nesting of objects and arrays that a client may send.
inline constexpr std::size_t json_depth_limit = 16;

/// Reads a text that a client sent.
/// @return nothing if it is not JSON, has a number beyond double, or is nested too deep
[[nodiscard]] std::optional<Json> parse_json(std::string_view text);

/// The text of a value. Bytes that are not UTF-8 become the replacement character.
[[nodiscard]] std::string to_text(const Json& json);

/// The numbers of a list that is a member of the object; none if there is no such member.
[[nodiscard]] std::vector<double> numbers_of(const Json& object, const char* member);

/// Appends the shortest text that reads back as the same double; null if it is not finite.
void append_number(std::string& text, double x);

/// Appends a string in quotes, escaped.
void append_string(std::string& text, std::string_view x);

}  // namespace articula::view
