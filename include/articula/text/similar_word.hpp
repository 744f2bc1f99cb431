// SPDX-License-Identifier: Apache-2.0
/// @file "Did you mean ...?": the known word that is nearest to a misspelt one.
#pragma once

#include "articula/core/name.hpp"
#include "articula/text/characters.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// The number of letters to insert, delete, replace, or swap with the next one, to turn one word
/// into the other. Capital letters count as small ones. Source: optimal string alignment, as in
/// Boytsov, Indexing methods for approximate dictionary searching, 2011.
/// @return the edit distance; the length of the longer word if a word is longer than any name
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  if (std::max(a.size(), b.size()) > Name::capacity) return std::max(a.size(), b.size());
  const auto letter = [](std::string_view word, std::size_t k) {
    return word[k] >= 'A' && word[k] <= 'Z' ? static_cast<char>(word[k] - 'A' + 'a') : word[k];
  };
  // row[k]: the distance from the first i letters of a to the first k letters of b.
  std::vector<std::size_t> row(b.size() + 1), last(row), last_but_one(row);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last_but_one.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const bool same = letter(a, i - 1) == letter(b, k - 1);
      row[k] = std::min({last[k - 1] + (same ? 0 : 1), last[k] + 1, row[k - 1] + 1});
      const bool swapped = i > 1 && k > 1 && letter(a, i - 1) == letter(b, k - 2) &&
                           letter(a, i - 2) == letter(b, k - 1);
      if (swapped) row[k] = std::min(row[k], last_but_one[k - 2] + 1);
    }
  }
  return row[b.size()];
}

/// True if one word is likely to be a misspelling of the other: they have letters in common and
/// differ by at most two, and by half of them.
[[nodiscard]] inline bool is_near(std::string_view a, std::string_view b) {
  const std::size_t longer = std::max(a.size(), b.size());
  if (longer > std::min(a.size(), b.size()) + 2) return false;
  const std::size_t distance = edit_distance(a, b);
  return distance <= 2 && 2 * distance <= longer;
}

/// The known word that an unknown word probably stands for; empty if no word is near, or if several
/// words are equally near.
/// @param words  the known words, a range of strings; the result refers to one of them
template <class Words>
[[nodiscard]] std::string_view similar_word(std::string_view unknown, const Words& words) {
  std::string_view meant;
  std::size_t nearest = unknown.size() + 3;
  for (const std::string_view word : words) {
    if (!is_near(unknown, word)) continue;
    const std::size_t distance = edit_distance(unknown, word);
    if (distance > nearest) continue;
    meant = distance < nearest ? word : std::string_view();
    nearest = distance;
  }
  return meant;
}

/// "; did you mean 'p'?" for the end of a message about an unknown word; empty if no word is near.
template <class Words>
[[nodiscard]] std::string did_you_mean(std::string_view unknown, const Words& words) {
  const std::string_view meant = similar_word(unknown, words);
  return meant.empty() ? "" : "; did you mean '" + shown(meant) + "'?";
}

/// "p, i, d".
/// @param most  number of words listed; "..." stands for the others
template <class Words>
[[nodiscard]] std::string list_of(const Words& words, std::size_t most = std::string_view::npos) {
  std::string list;
  std::size_t listed = 0;
  for (const std::string_view word : words) {
    if (!list.empty()) list += ", ";
    if (listed++ == most) return list + "...";
    list += shown(word);
  }
  return list;
}

/// "one of p, i, d; did you mean 'p'?", for messages about an unknown word.
/// @param most  number of words listed; of more words, the nearest are listed
template <class Words>
[[nodiscard]] std::string one_of_words(std::string_view unknown, const Words& words,
                                       std::size_t most = std::string_view::npos) {
  std::vector<std::string_view> order(words.begin(), words.end());
  if (order.size() > most) {
    std::multimap<std::size_t, std::string_view> by_share;  // of other letters [%]
    for (const std::string_view word : order) {
      const std::size_t longer = std::max({word.size(), unknown.size(), std::size_t{1}});
      by_share.emplace(100 * edit_distance(unknown, word) / longer, word);
    }
    order.clear();
    for (const auto& [share, word] : by_share) order.push_back(word);
  }
  return "one of " + list_of(order, most) + did_you_mean(unknown, words);
}

/// The end of a message about a name that does not exist: the name that was probably meant, or else
/// all names.
/// @param kind   of the names, "links"
/// @param names  those that exist
template <class Words>
[[nodiscard]] std::string choice_of(std::string_view name, std::string_view kind,
                                    const Words& names) {
  const std::string meant = did_you_mean(name, names);
  return meant.empty() ? "; " + std::string(kind) + ": " + list_of(names) : meant;
}

}  // namespace articula::detail
