// SPDX-License-Identifier: Apache-2.0
/// @file A first look at the tags of an XML text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace articula::detail {

/// Looks at the tags of an XML text before TinyXML does, which descends by recursion, so that deep
/// nesting would exhaust the stack, and reads over attributes without quotes and the like.
class TagReader {
 public:
  static constexpr int deepest = 100;  ///< nesting of elements that is accepted

  explicit TagReader(std::string_view text) : text_(text) {}

  /// What is wrong, empty if nothing is.
  [[nodiscard]] const char* fault() {
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      const char* fault = tag();
      if (fault) return fault;
      if (depth_ > deepest) return "elements are nested more than 100 deep";
      if (depth_ < 0) return "an element is closed that was not opened";
    }
    at_ = text_.size();
    return depth_ > 0 ? "an element is not closed" : nullptr;
  }

  /// The line that was read last, from 1.
  [[nodiscard]] std::size_t line() const {
    const std::size_t end = std::min(at_, text_.size());
    return 1 + static_cast<std::size_t>(std::count(
                   text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  }

 private:
  [[nodiscard]] bool take(std::string_view expected) {
    if (!text_.substr(at_).starts_with(expected)) return false;
    at_ += expected.size();
    return true;
  }
  [[nodiscard]] bool take_until(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) return false;
    at_ = found + end.size();
    return true;
  }
  void skip_space() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
  [[nodiscard]] bool take_name() {
    const std::size_t start = at_;
    at_ = std::min(text_.find_first_of(" \t\r\n=/<>\"'", at_), text_.size());
    return at_ > start;
  }

  /// Reads one tag, comment or the like, which begins here.
  [[nodiscard]] const char* tag() {
    if (take("<!--")) return take_until("-->") ? nullptr : "a comment is not closed";
    if (take("<![CDATA[")) return take_until("]]>") ? nullptr : "a CDATA part is not closed";
    if (take("<?")) {
      return take_until(">") && text_[at_ - 2] == '?' ? nullptr : "a <? is not closed by ?>";
    }
    if (take("<!")) return "a document type or entity, which URDF has not";
    if (take("</")) {
      --depth_;
      if (!take_name()) return "a closing tag has no name";
      skip_space();
      return take(">") ? nullptr : "a closing tag has no end";
    }
    ++at_;
    return opening_tag();
  }

  [[nodiscard]] const char* opening_tag() {
    if (!take_name()) return "a tag has no name";
    for (;;) {
      skip_space();
      if (take("/>")) return nullptr;
      if (take(">")) {
        ++depth_;
        return nullptr;
      }
      if (!take_name()) return "a tag has no end";
      skip_space();
      if (!take("=")) return "an attribute has no value";
      skip_space();
      const bool value = take("\"") ? take_until("\"") : take("'") && take_until("'");
      if (!value) return "an attribute's value is not between quotes";
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// What is wrong with the tags of an XML text, with the line; empty if nothing is.
[[nodiscard]] inline std::string tag_fault(std::string_view text) {
  TagReader reader(text);
  const char* fault = reader.fault();
  return fault ? "line " + std::to_string(reader.line()) + ": " + fault : "";
}

}  // namespace articula::detail
