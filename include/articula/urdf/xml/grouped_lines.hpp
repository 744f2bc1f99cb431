// SPDX-License-Identifier: Apache-2.0
/// @file What is odd in many places of a file, in a line each.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace articula::detail {

/// Collects lines about the elements of a file. What is odd in several elements has one line, with
/// the first element that has it and how many others do.
class GroupedLines {
 public:
  /// @param owner  the element, such as "link 'arm': "
  /// @param text   what is odd there
  void add(const std::string& owner, const std::string& text) {
    const auto [at, is_new] = index_.try_emplace(text, lines_.size());
    if (is_new) {
      lines_.push_back({.first = owner, .last = owner, .text = text});
      return;
    }
    Line& known = lines_[at->second];
    if (known.last == owner) return;  // one element may have it often
    known.last = owner;
    ++known.others;
  }

  [[nodiscard]] std::vector<std::string> take() const {
    std::vector<std::string> lines;
    for (const Line& line : lines_) {
      lines.push_back(line.first + line.text);
      if (line.others == 0) continue;
      lines.back() += (lines.back().ends_with('?') ? " " : "; ") + std::to_string(line.others) +
                      " other" + (line.others == 1 ? " has" : "s have") + " it, too";
    }
    return lines;
  }

 private:
  struct Line {
    std::string first{};  ///< the element that has it first
    std::string last{};   ///< and the one that had it last
    std::string text{};
    std::size_t others = 0;  ///< elements besides the first
  };

  std::vector<Line> lines_{};
  std::map<std::string, std::size_t> index_{};  ///< of the lines, by text
};

}  // namespace articula::detail
