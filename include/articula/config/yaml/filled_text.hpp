// SPDX-License-Identifier: Apache-2.0
/// @file A text whose placeholders have been given their values.
#pragma once

#include "articula/config/yaml/node.hpp"
#include "articula/config/yaml/source.hpp"
#include "articula/text/file_error.hpp"
#include "articula/text/placeholder.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// What became of a text, and where in the file its characters stand.
class FilledText {
 public:
  /// @param text    with a line feed behind each line
  /// @param values  of placeholders; others are left as they are
  /// @throws FileError if a value is more than a line, or the result larger than a source may be
  FilledText(const std::string& file, std::string text, const ConfigValues& values) {
    for (const auto& [name, value] : values) {
      const bool one_line = std::none_of(
          value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
      if (one_line) continue;
      throw FileError({.file = file}, "the value given for '" + name + "' has a line break or tab",
                      "a line of text");
    }
    if (values.empty()) {
      text_ = std::move(text);
      return;
    }
    fill(text, values);
    if (text_.size() > ConfigSource::capacity) {
      throw FileError({.file = file}, "it is larger than 1 MiB, values included",
                      "a configuration file");
    }
  }

  [[nodiscard]] const std::string& text() const noexcept { return text_; }

  /// Where in the file stands what stands here in the text. Line and column count from 1.
  [[nodiscard]] ConfigMark in_file(ConfigMark mark) const noexcept {
    // What begins with a value begins where its placeholder does.
    const auto next = std::lower_bound(
        changes_.begin(), changes_.end(), mark, [](const Change& change, const ConfigMark& at) {
          return std::pair(change.line, change.column) < std::pair(at.line, at.column);
        });
    if (next == changes_.begin() || std::prev(next)->line != mark.line) return mark;
    const Change& last = *std::prev(next);
    // A value has no characters of its own in the file: all of it stands at the placeholder.
    const int in = mark.column - last.column;
    return {mark.line,
            in < last.now ? last.file_column : last.file_column + last.before + in - last.now};
  }

 private:
  /// A placeholder that was filled in.
  struct Change {
    int line = 1;
    int column = 1;       ///< in the new text
    int file_column = 1;  ///< in the file
    int before = 0;       ///< length of the placeholder
    int now = 0;          ///< length of the value
  };

  /// The placeholder at which a text begins; $kp ends where the name does.
  [[nodiscard]] static std::string_view any_placeholder_at(std::string_view text) {
    const std::string_view found = placeholder_at(text);
    if (!found.empty() || !text.starts_with('$')) return found;
    const std::size_t end = text.find_first_not_of(
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", 1);
    return text.substr(0, end);
  }

  void fill(std::string_view text, const ConfigValues& values) {
    Change here;
    while (!text.empty()) {
      const std::string_view found = any_placeholder_at(text.substr(0, text.find('\n')));
      const auto value = found.empty() ? values.end() : values.find(placeholder_name(found));
      if (value != values.end()) {
        here.before = static_cast<int>(found.size());
        here.now = static_cast<int>(value->second.size());
        changes_.push_back(here);
        text_ += value->second;
        text.remove_prefix(found.size());
        here.column += here.now;
        here.file_column += here.before;
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

  std::string text_{};
  std::vector<Change> changes_{};
};

}  // namespace articula::detail
