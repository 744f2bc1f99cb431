// SPDX-License-Identifier: Apache-2.0
/// @file Lists of numbers with decimal commas, which YAML takes for lists of twice as many.
#pragma once

#include "articula/config/yaml/config_value.hpp"
#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/scalar.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// True if an item may be one side of a decimal comma: digits and, before the comma, a sign.
[[nodiscard]] inline bool is_whole(const ConfigNode& item, bool may_have_sign) {
  std::string_view digits = item.text;
  if (may_have_sign && (digits.starts_with('-') || digits.starts_with('+')))
    digits.remove_prefix(1);
  return item.kind == ConfigNode::Kind::scalar && !item.quoted && !digits.empty() &&
         digits.find_first_not_of("0123456789") == std::string_view::npos;
}

/// True if a list is written in pairs, with no blank in a pair and some between pairs: [1,5, 2,5].
/// (A matrix has a line for each row.)
[[nodiscard]] inline bool is_in_pairs(const std::vector<ConfigNode>& items) {
  for (std::size_t k = 1; k < items.size(); ++k) {
    const int end = items[k - 1].mark.column + static_cast<int>(items[k - 1].text.size());
    const int gap = items[k].mark.column - end;  // 1: the comma alone
    const bool in_line = items[k].mark.line == items[k - 1].mark.line;
    if (!in_line || (k % 2 == 1 ? gap != 1 : gap == 1)) return false;
  }
  return true;
}

/// True if a matrix by rows is diagonal, as it is written.
[[nodiscard]] inline bool is_diagonal(const std::vector<ConfigNode>& items, std::size_t n) {
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k % (n + 1) != 0 && items[k].text.find_first_not_of('0') != std::string::npos) return false;
  }
  return items.size() == n * n;
}

/// Refuses lists that are neither n numbers nor an n x n matrix by rows. What seem to be decimal
/// commas are named; two joints' may look like a matrix, [1,0, 0,5], which a blank behind every
/// comma makes sure.
/// @throws FileError with the numbers that were probably meant
inline void refuse_length(const ConfigValue& value, std::size_t n) {
  const std::vector<ConfigNode>& items = value.node().items;
  const bool is_right = items.size() == n || items.size() == n * n;
  bool are_whole = items.size() > n && items.size() <= 2 * n;
  for (std::size_t k = 0; k < items.size(); ++k) {
    are_whole = are_whole && is_whole(items[k], k % 2 == 0);
  }
  const std::string a_number =
      "a number for each of " + std::to_string(n) + (n == 1 ? " joint" : " joints");
  if (are_whole && items.size() == 2 * n) {
    const bool may_be_matrix = is_diagonal(items, n);
    if (may_be_matrix && !is_in_pairs(items)) return;
    std::string meant;
    for (std::size_t k = 0; k < items.size(); k += 2) {
      meant += (k == 0 ? "" : ", ") + items[k].text + "." + items[k + 1].text;
    }
    value.refuse(a_number + ", [" + shown(meant) + "] if there are decimal commas" +
                 (may_be_matrix ? ", or a blank behind every comma of a matrix by rows" : ""));
  }
  if (is_right) return;
  value.refuse(a_number + ", or a matrix by rows" + (are_whole ? "; with decimal points" : ""));
}

}  // namespace articula::detail
