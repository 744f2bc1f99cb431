// SPDX-License-Identifier: Apache-2.0
/// @file What was meant by a word that does not exist.
#pragma once

#include "articula/core/name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// How many letters have to be put in, left out, replaced or swapped with the next to make one word
/// of the other. Source: optimal string alignment, as in Boytsov, Indexing methods for approximate
/// dictionary searching, 2011.
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  // From the first i letters of a to each beginning of b, and for i - 1 and i - 2.
  std::vector<std::size_t> row(b.size() + 1), last(row), last_but_one(row);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last_but_one.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t replaced = last[k - 1] + (a[i - 1] == b[k - 1] ? 0 : 1);
      row[k] = std::min({replaced, last[k] + 1, row[k - 1] + 1});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) {
        row[k] = std::min(row[k], last_but_one[k - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

/// The word that was meant by one that is not among them: at most two letters off, capital letters
/// not counted; empty if there is none, or if several are as close. Nothing is looked for where the
/// word is longer than any name.
[[nodiscard]] inline std::string_view meant_word(std::string_view unknown,
                                                 std::span<const std::string_view> words) {
  constexpr std::size_t farthest = 2;
  if (unknown.size() > Name::capacity) return {};
  const auto without_capitals = [](std::string_view word) {
    std::string small(word);
    for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return small;
  };
  const std::string small = without_capitals(unknown);
  std::string_view meant;
  std::size_t nearest = farthest + 1;
  for (const std::string_view word : words) {
    const std::size_t longer = std::max(small.size(), word.size());
    if (longer > std::min(small.size(), word.size()) + farthest) continue;  // however long it is
    const std::size_t distance = edit_distance(small, without_capitals(word));
    const bool shares_letters = distance < longer;
    if (distance > nearest || distance > farthest || !shares_letters) continue;
    meant = distance < nearest ? word : std::string_view();
    nearest = distance;
  }
  return meant;
}

/// The end of a message about a name that does not exist: what was meant, or what there is.
/// @param kind   of the names, "links"
/// @param names  those that exist
[[nodiscard]] inline std::string choice_of(std::string_view name, std::string_view kind,
                                           std::span<const std::string_view> names) {
  const std::string_view meant = meant_word(name, names);
  if (!meant.empty()) return "; did you mean '" + std::string(meant) + "'?";
  std::string list;
  for (const std::string_view each : names) list.append(list.empty() ? " " : ", ").append(each);
  return "; " + std::string(kind) + ":" + list;
}

}  // namespace articula::detail
