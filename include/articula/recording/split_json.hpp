// SPDX-License-Identifier: Apache-2.0
/// @file Splits long JSON into several short texts. Needs nlohmann-json (target articula::recording).
#pragma once

#include "articula/recording/record_json.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace articula {

/// Splits a record into texts of limited length. Each is JSON of the same shape: it has all values
/// of the first level ("timestamp"), and whole members of the objects there (joints, links).
/// @param json     an object, of which some members may be objects
/// @param longest  length of a text [bytes]. A member that is longer has a text of its own; that of
///                 a joint has at most 1000 bytes, its name included.
/// @return         one text if everything fits
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
