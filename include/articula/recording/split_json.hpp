// SPDX-License-Identifier: Apache-2.0
/// @file Long JSON in several short texts. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/recording/record_json.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace articula {

/// Splits a record into texts of limited length, each of which is JSON of the same shape: all have
/// the values of the first level ("timestamp"), and between them the members of its objects (the
/// joints, the links), each member whole. One text if everything fits.
/// @param json     an object, of which some members may be objects
/// @param longest  length of a text [bytes]. A member that alone is longer gets a longer text; that
///                 of a joint has 1000 bytes at most, its name included.
/// Real-time: no (allocates).
[[nodiscard]] inline std::vector<std::string> split_json(const Json& json, std::size_t longest) {
  std::string whole = json.dump();
  if (whole.size() <= longest) return {whole};
  std::string values;
  for (const auto& [name, member] : json.items()) {
    if (!member.is_object()) values += Json(name).dump() + ":" + member.dump() + ",";
  }
  std::vector<std::string> texts;
  for (const auto& [name, members] : json.items()) {
    if (!members.is_object()) continue;
    const std::string head = "{" + values + Json(name).dump() + ":{", end = "}}";
    std::string text;
    for (const auto& [key, member] : members.items()) {
      const std::string entry = Json(key).dump() + ":" + member.dump();
      if (!text.empty() && text.size() + 1 + entry.size() + end.size() > longest) {
        texts.push_back(text + end);
        text.clear();
      }
      text += (text.empty() ? head : ",") + entry;
    }
    if (!text.empty()) texts.push_back(text + end);
  }
  return texts;
}

}  // namespace articula
