// SPDX-License-Identifier: Apache-2.0
/// @file A first look at the tags of an XML text.
#pragma once

#include "articula/urdf/xml/error.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Looks at the tags of an XML text before TinyXML does, which descends by recursion, so that deep
/// nesting would exhaust the stack, reads over attributes without quotes and the like, and ends
/// document types and processing instructions at the first '>': those become blanks.
class TagReader {
 public:
  static constexpr std::size_t deepest = 100;  ///< nesting of elements that is accepted

  explicit TagReader(std::string& text) : text_(text) {}

  /// What is wrong, empty if nothing is.
  [[nodiscard]] std::string fault() {
    for (;;) {
      const std::size_t start = at_;
      at_ = std::min(view().find('<', start), text_.size());
      if (open_.empty()) {
        const std::size_t text = view().find_first_not_of(space, start == 0 ? skip_mark() : start);
        if (text < at_) {
          at_ = text;
          return "there is text outside of the robot";
        }
      }
      if (std::string fault = references(start, at_); !fault.empty()) return fault;
      if (at_ == text_.size()) break;
      if (std::string fault = tag(); !fault.empty()) return fault;
      if (open_.size() > deepest) return "elements are nested more than 100 deep";
    }
    return open_.empty() ? "" : innermost() + " is not closed";
  }

  /// The line that was read last, from 1.
  [[nodiscard]] int line() const { return line_of(at_); }

 private:
  static constexpr std::string_view space = " \t\r\n";

  struct OpenElement {
    std::string_view name;
    std::size_t begin;
  };

  [[nodiscard]] int line_of(std::size_t place) const {
    const auto end = static_cast<std::ptrdiff_t>(std::min(place, text_.size()));
    return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + end, '\n'));
  }
  /// The element that is to be closed next, in words.
  [[nodiscard]] std::string innermost() const {
    return "<" + std::string(open_.back().name) + "> of line " +
           std::to_string(line_of(open_.back().begin));
  }

  [[nodiscard]] std::string_view view() const { return text_; }
  [[nodiscard]] bool take(std::string_view expected) {
    if (!view().substr(at_).starts_with(expected)) return false;
    at_ += expected.size();
    return true;
  }
  [[nodiscard]] bool take_until(std::string_view end) {
    const std::size_t found = view().find(end, at_);
    if (found == std::string_view::npos) return false;
    at_ = found + end.size();
    return true;
  }
  void skip_space() { at_ = std::min(view().find_first_not_of(space, at_), text_.size()); }
  [[nodiscard]] bool take_name() {
    const std::size_t start = at_;
    at_ = std::min(view().find_first_of(" \t\r\n=/<>\"'", at_), text_.size());
    return at_ > start;
  }
  /// A text between quotes.
  [[nodiscard]] bool take_literal() {
    return take("\"") ? take_until("\"") : take("'") && take_until("'");
  }
  /// Where the text begins behind UTF-8's byte order mark.
  [[nodiscard]] std::size_t skip_mark() const { return view().starts_with("\xEF\xBB\xBF") ? 3 : 0; }
  /// Lines keep their numbers.
  void blank(std::size_t begin) {
    for (std::size_t k = begin; k < at_; ++k) {
      if (space.find(text_[k]) == std::string_view::npos) text_[k] = ' ';
    }
  }

  /// Entities stand for what a document type says, which is not read; TinyXML would take the
  /// reference for text.
  [[nodiscard]] std::string references(std::size_t begin, std::size_t end) {
    constexpr std::array<std::string_view, 5> known = {"amp", "lt", "gt", "quot", "apos"};
    const std::string_view text = view().substr(begin, end - begin);
    for (std::size_t k = text.find('&'); k != std::string_view::npos; k = text.find('&', k + 1)) {
      const std::size_t last = text.find_first_of(" \t\r\n<>&\"';", k + 1);
      // An ampersand that begins no reference is read as itself, though XML wants it as &amp;
      if (last == std::string_view::npos || text[last] != ';') continue;
      const std::string_view name = text.substr(k + 1, last - k - 1);
      if (name.empty() || name.starts_with('#')) continue;
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      at_ = begin + k;
      return "the entity &" + std::string(name) + "; is used, but only XML's own are read";
    }
    return "";
  }

  /// Reads one tag, comment or the like, which begins here.
  [[nodiscard]] std::string tag() {
    const std::size_t start = at_;
    if (take("<!--")) return take_until("-->") ? "" : "a comment is not closed";
    if (take("<![CDATA[")) return take_until("]]>") ? "" : "a CDATA part is not closed";
    if (take("<?")) {
      const bool is_declaration =
          take("xml") && at_ < text_.size() && space.find(text_[at_]) != std::string_view::npos;
      if (!take_until("?>")) return "a <? is not closed by ?>";
      if (!is_declaration || view().find('>', start) + 1 != at_) blank(start);
      return "";
    }
    if (take("<!DOCTYPE")) {
      if (has_root_) return "a document type stands behind the beginning of the robot";
      if (has_type_) return "a second document type; XML has one";
      has_type_ = true;
      std::string fault = document_type();
      if (fault.empty()) blank(start);
      return fault;
    }
    if (take("<!")) return "a <! that begins no comment, CDATA part or document type";
    if (take("</")) {
      const std::size_t begin = at_;
      if (!take_name()) return "a closing tag has no name";
      const std::string_view name = view().substr(begin, at_ - begin);
      const std::string tag = "</" + std::string(name) + ">";
      if (open_.empty()) return tag + " closes what was not opened";
      if (name != open_.back().name)
        return tag + " stands where " + innermost() + " is to be closed";
      open_.pop_back();
      skip_space();
      return take(">") ? "" : "a closing tag has no end";
    }
    ++at_;
    if (open_.empty() && has_root_) return "a second element at the top; XML has one";
    has_root_ = true;
    return opening_tag();
  }

  /// The rest of a document type, with what it declares.
  [[nodiscard]] std::string document_type() {
    constexpr const char* open = "a document type is not closed";
    bool declares = false, has_defaults = false;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (take("<!--")) {
        if (!take_until("-->")) return "a comment is not closed";
      } else if (take("<?")) {
        if (!take_until("?>")) return "a <? is not closed by ?>";
      } else if (c == '"' || c == '\'') {
        if (has_defaults) return "a document type has values of attributes, which are not read";
        if (!take_literal()) return open;
      } else if (declares && c == '%' && at_ + 1 < text_.size() &&
                 space.find(text_[at_ + 1]) == std::string_view::npos) {
        return "an entity of the document type is used, which is not read";
      } else if (take("<!ATTLIST")) {
        has_defaults = true;
      } else {
        ++at_;
        if (c == '[') declares = true;
        if (c == ']') declares = false;
        if (c == '>') has_defaults = false;
        if (c == '>' && !declares) return "";
      }
    }
    return open;
  }

  [[nodiscard]] std::string opening_tag() {
    const std::size_t begin = at_;
    if (!take_name()) return "a tag has no name";
    const OpenElement element{view().substr(begin, at_ - begin), begin};
    std::set<std::string_view> names;
    for (;;) {
      skip_space();
      if (take("/>")) return "";
      if (take(">")) {
        open_.push_back(element);
        return "";
      }
      std::size_t start = at_;
      if (!take_name()) return "a tag has no end";
      const std::string_view name = view().substr(start, at_ - start);
      if (!names.insert(name).second) {
        return "the attribute '" + std::string(name) + "' is given twice";
      }
      skip_space();
      if (!take("=")) return "an attribute has no value";
      skip_space();
      start = at_;
      if (!take_literal()) return "an attribute's value is not between quotes";
      if (std::string fault = references(start, at_); !fault.empty()) return fault;
    }
  }

  std::string& text_;
  std::size_t at_ = 0;
  std::vector<OpenElement> open_{};
  bool has_root_ = false;
  bool has_type_ = false;
};

/// Checks the tags of an XML text. What TinyXML would misread and nobody needs becomes blanks.
/// @throws UrdfError with the line
inline void check_tags(const std::string& file, std::string& text) {
  TagReader reader(text);
  const std::string fault = reader.fault();
  if (!fault.empty()) throw UrdfError({.file = file, .line = reader.line()}, fault);
}

}  // namespace articula::detail
