// SPDX-License-Identifier: Apache-2.0
/// @file Check of the tags of an XML text before TinyXML parses it.
#pragma once

#include "articula/text/file_error.hpp"
#include "articula/text/numbers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Checks the tags of an XML text before TinyXML parses it. TinyXML recurses, so deep nesting would
/// exhaust the stack; it accepts attributes without quotes; and it ends document types and
/// processing instructions at the first '>'. This class replaces the latter two by blanks.
class TagChecker {
 public:
  static constexpr std::size_t max_depth = 100;  ///< of nested elements

  TagChecker(const std::string& file, std::string& text) : file_(file), text_(text) {}

  /// @throws FileError with the line and the fault
  void check() {
    for (;;) {
      const std::size_t start = at_;
      at_ = std::min(view().find('<', start), text_.size());
      if (open_.empty()) {
        const bool has_mark = start == 0 && view().starts_with("\xEF\xBB\xBF");  // of UTF-8
        const std::size_t text = view().find_first_not_of(white_space, has_mark ? 3 : start);
        if (text < at_) {
          at_ = text;
          fail("there is text outside of the top element");
        }
      }
      check_references(start);
      if (at_ == text_.size()) break;
      read_tag();
      if (open_.size() > max_depth) fail("elements are nested more than 100 deep");
    }
    if (!open_.empty()) fail(innermost() + " is not closed");
  }

 private:
  struct OpenElement {
    std::string_view name;
    std::size_t begin;
  };

  [[noreturn]] void fail(const std::string& fault) const {
    throw FileError({.file = file_, .line = line_of(at_)}, fault);
  }

  [[nodiscard]] int line_of(std::size_t position) const {
    const std::string_view before = view().substr(0, position);
    return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  }
  /// The element to be closed next, for messages.
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
  void skip_past(std::string_view end, const char* fault) {
    const std::size_t found = view().find(end, at_);
    if (found == std::string_view::npos) fail(fault);
    at_ = found + end.size();
  }
  void skip_space() { at_ = std::min(view().find_first_not_of(white_space, at_), text_.size()); }
  [[nodiscard]] std::string_view take_name(const char* fault) {
    const std::size_t start = at_;
    at_ = std::min(view().find_first_of(" \t\r\n=/<>\"'", at_), text_.size());
    if (at_ == start) fail(fault);
    return view().substr(start, at_ - start);
  }
  void skip_literal(const char* fault) {
    const std::string_view quote = view().substr(at_, 1);
    if (quote != "\"" && quote != "'") fail(fault);
    ++at_;
    skip_past(quote, fault);
  }
  /// Replaces the text up to here by blanks, so that lines keep their numbers.
  void blank(std::size_t begin) {
    for (std::size_t k = begin; k < at_; ++k) {
      if (white_space.find(text_[k]) == std::string_view::npos) text_[k] = ' ';
    }
  }

  /// Refuses entities that a document type declares, from `begin` to here: TinyXML would read the
  /// reference as text.
  void check_references(std::size_t begin) {
    constexpr std::array<std::string_view, 5> known = {"amp", "lt", "gt", "quot", "apos"};
    const std::string_view text = view().substr(begin, at_ - begin);
    for (std::size_t k = text.find('&'); k != std::string_view::npos; k = text.find('&', k + 1)) {
      const std::size_t last = text.find_first_of(" \t\r\n<>&\"';", k + 1);
      // An ampersand that begins no reference stands for itself, although XML demands &amp;
      if (last == std::string_view::npos || text[last] != ';') continue;
      const std::string_view name = text.substr(k + 1, last - k - 1);
      if (name.empty() || name.starts_with('#')) continue;
      if (std::ranges::find(known, name) != known.end()) continue;
      at_ = begin + k;
      fail("the entity &" + std::string(name) +
           "; is not supported: write its text (&amp; &lt; &gt; &quot; &apos; are supported)");
    }
  }

  /// Reads the tag, comment, instruction or document type that begins here.
  void read_tag() {
    const std::size_t start = at_;
    if (take("<!--")) return skip_past("-->", "a comment is not closed");
    if (take("<![CDATA[")) return skip_past("]]>", "a CDATA section is not closed");
    if (take("<?")) {
      const bool is_declaration = take("xml") && at_ < text_.size() &&
                                  white_space.find(text_[at_]) != std::string_view::npos;
      skip_past("?>", "a <? is not closed by ?>");
      if (!is_declaration || view().find('>', start) + 1 != at_) blank(start);
      return;
    }
    if (take("<!DOCTYPE")) {
      if (has_root_) fail("the document type must stand before the top element");
      if (has_type_) fail("there is a second document type; XML allows one");
      has_type_ = true;
      read_document_type();
      return blank(start);
    }
    if (take("<!")) fail("<! begins neither a comment, a CDATA section nor a document type");
    if (take("</")) {
      const std::string_view name = take_name("a closing tag has no name");
      const std::string tag = "</" + std::string(name) + ">";
      if (open_.empty()) fail(tag + " closes no open element");
      if (name != open_.back().name) fail(tag + " is found, but " + innermost() + " is open");
      open_.pop_back();
      skip_space();
      if (!take(">")) fail("a closing tag has no end");
      return;
    }
    ++at_;
    if (open_.empty() && has_root_) fail("there is a second top element; XML allows one");
    has_root_ = true;
    read_opening_tag();
  }

  /// Reads the rest of a document type with its declarations.
  void read_document_type() {
    constexpr const char* unclosed = "the document type is not closed";
    bool in_declarations = false, in_attributes = false;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (take("<!--")) {
        skip_past("-->", "a comment is not closed");
      } else if (take("<?")) {
        skip_past("?>", "a <? is not closed by ?>");
      } else if (c == '"' || c == '\'') {
        if (in_attributes) fail("values of attributes in a document type are not supported");
        skip_literal(unclosed);
      } else if (in_declarations && c == '%' && at_ + 1 < text_.size() &&
                 white_space.find(text_[at_ + 1]) == std::string_view::npos) {
        fail("the use of an entity in a document type is not supported");
      } else if (take("<!ATTLIST")) {
        in_attributes = true;
      } else {
        ++at_;
        if (c == '[') in_declarations = true;
        if (c == ']') in_declarations = false;
        if (c == '>') in_attributes = false;
        if (c == '>' && !in_declarations) return;
      }
    }
    fail(unclosed);
  }

  void read_opening_tag() {
    const std::size_t begin = at_;
    const OpenElement element{take_name("a tag has no name"), begin};
    std::set<std::string_view> names;
    for (;;) {
      skip_space();
      if (take("/>")) return;
      if (take(">")) return open_.push_back(element);
      const std::string_view name = take_name("a tag has no end");
      if (!names.insert(name).second) {
        fail("the attribute '" + std::string(name) + "' is given twice");
      }
      skip_space();
      if (!take("=")) fail("an attribute has no value");
      skip_space();
      const std::size_t value = at_;
      skip_literal("an attribute's value is not in quotes");
      check_references(value);
    }
  }

  const std::string& file_;
  std::string& text_;
  std::size_t at_ = 0;  ///< index of the next character
  std::vector<OpenElement> open_{};
  bool has_root_ = false;
  bool has_type_ = false;
};

}  // namespace articula::detail
