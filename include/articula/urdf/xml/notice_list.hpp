// SPDX-License-Identifier: Apache-2.0
/// @file Notices about the elements of a URDF file.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace articula::detail {

/// Collects notices. The same text about several elements becomes one line, with the first element
/// and the number of the others.
class NoticeList {
 public:
  /// @param owner  the element, such as "link 'arm': "
  /// @param text   the notice about it
  void add(const std::string& owner, const std::string& text) {
    const auto [at, is_new] = index_.try_emplace(text, notices_.size());
    if (is_new) return notices_.push_back({.first = owner, .last = owner, .text = text});
    Notice& known = notices_[at->second];
    if (known.last == owner) return;  // one element may repeat the text
    known.last = owner;
    ++known.others;
  }

  /// Adds a line of its own.
  void add(const std::string& line) { notices_.push_back({.first = "", .last = "", .text = line}); }

  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const Notice& notice : notices_) {
      lines.push_back(notice.first + notice.text);
      if (notice.others == 0) continue;
      lines.back() += (notice.text.ends_with('?') ? " Also in " : "; also in ") +
                      std::to_string(notice.others) + " other" + (notice.others == 1 ? "" : "s");
    }
    return lines;
  }

 private:
  struct Notice {
    std::string first{};  ///< the first element that has it
    std::string last{};   ///< the last element that has it
    std::string text{};
    std::size_t others = 0;  ///< number of elements besides the first
  };

  std::vector<Notice> notices_{};
  std::map<std::string, std::size_t> index_{};  ///< of the notices, by text
};

}  // namespace articula::detail
