// SPDX-License-Identifier: Apache-2.0
#include "articula/view/protocol/json/json.hpp"

#include <charconv>
#include <cmath>

namespace articula::view {

namespace {

/// Whether objects and arrays are nested no deeper than allowed. Looked at before the text is read,
/// so that a hostile text costs no memory.
bool is_shallow(std::string_view text) {
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth > json_depth_limit) return false;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return true;
}

}  // namespace

std::optional<Json> parse_json(std::string_view text) {
  if (!is_shallow(text)) return std::nullopt;
  Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  return json;
}

std::string to_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<double> numbers_of(const Json& object, const char* member) {
  return object.value(member, std::vector<double>{});
}

void append_number(std::string& text, double x) {
  if (!std::isfinite(x)) {
    text += "null";
    return;
  }
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
  text.append(digits, end);
  if (x == 0 && std::signbit(x)) text += ".0";  // readers take -0 for an integer without a sign
}

void append_string(std::string& text, std::string_view x) { text += to_text(Json(x)); }

}  // namespace articula::view
