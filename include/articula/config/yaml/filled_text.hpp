// SPDX-License-Identifier: Apache-2.0
/// @file A text with values in place of placeholders, and where its characters are in the file.
#pragma once

#include "articula/config/yaml/source.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/placeholder.hpp"

#include <yaml-cpp/mark.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// Calls `use` with the number of each line, from 1, and the line.
template <class Use>
void for_each_line(std::string_view text, Use use) {
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    use(number, line);
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
}

/// A line of a text, from 1; empty if there is none.
[[nodiscard]] inline std::string_view line_of(std::string_view text, int wanted) {
  std::string_view found;
  for_each_line(text, [&](int number, std::string_view line) {
    if (number == wanted) found = line;
  });
  return found;
}

/// A text in which values have replaced placeholders.
class FilledText {
 public:
  /// @param text    with a line feed behind each line
  /// @param values  of placeholders; placeholders without a value remain
  /// @throws FileError if a value has control characters, or the result is larger than a source may
  ///         be
  FilledText(const std::string& file, std::string text, const ConfigValues& values) : file_(file) {
    for (const auto& [name, value] : values) {
      const bool is_line = std::none_of(
          value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
      if (is_line) continue;
      throw FileError({.file = file}, "the value of '" + name + "' has a line break or tab",
                      "a line of text");
    }
    values.empty() ? text_.swap(text) : fill(text, values);
    if (text_.size() > ConfigSource::capacity) {
      throw FileError({.file = file}, "it is larger than 1 MiB, values included",
                      "a configuration file");
    }
  }

  [[nodiscard]] const std::string& text() const noexcept { return text_; }

  /// The position in the file of a position in this text. All characters of a value are at its
  /// placeholder.
  [[nodiscard]] FilePlace in_file(const YAML::Mark& mark) const {
    FilePlace place{file_, std::max(mark.line, 0) + 1, std::max(mark.column, 0) + 1};
    const auto next = std::lower_bound(
        changes_.begin(), changes_.end(), place, [](const Change& change, const FilePlace& at) {
          return std::pair(change.line, change.column) < std::pair(at.line, at.column);
        });
    if (next == changes_.begin() || std::prev(next)->line != place.line) return place;
    const Change& last = *std::prev(next);
    const int behind = place.column - last.column - last.new_length;
    place.column = last.file_column + (behind < 0 ? 0 : last.old_length + behind);
    return place;
  }

 private:
  /// A placeholder that has been replaced.
  struct Change {
    int line = 1;
    int column = 1;       ///< in the new text
    int file_column = 1;  ///< in the file
    int old_length = 0;   ///< of the placeholder
    int new_length = 0;   ///< of the value
  };

  /// The placeholder at the beginning of a text, within its first line; $kp ends with its name.
  [[nodiscard]] static std::string_view any_placeholder_at(std::string_view text) {
    if (std::string_view("{<$@%").find(text[0]) == std::string_view::npos) return {};
    text = text.substr(0, text.find('\n'));
    const std::string_view found = placeholder_at(text);
    if (!found.empty() || !text.starts_with('$')) return found;
    return text.substr(
        0, text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_",
                                  1));
  }

  void fill(std::string_view text, const ConfigValues& values) {
    Change here;
    while (!text.empty()) {
      const std::string_view found = any_placeholder_at(text);
      const auto value = found.empty() ? values.end() : values.find(placeholder_name(found));
      if (value != values.end()) {
        here.old_length = static_cast<int>(found.size());
        here.new_length = static_cast<int>(value->second.size());
        changes_.push_back(here);
        text_ += value->second;
        text.remove_prefix(found.size());
        here.column += here.new_length;
        here.file_column += here.old_length;
        continue;
      }
      const bool ends_line = text[0] == '\n';
      here.line += ends_line ? 1 : 0;
      here.column = ends_line ? 1 : here.column + 1;
      here.file_column = ends_line ? 1 : here.file_column + 1;
      text_ += text[0];
      text.remove_prefix(1);
    }
  }

  std::string file_;
  std::string text_{};
  std::vector<Change> changes_{};
};

}  // namespace articula::detail
