// SPDX-License-Identifier: Apache-2.0
/// @file XML as it is put together, element by element.
#pragma once

#include "articula/text/numbers.hpp"

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace articula::detail {

/// A text as the value of an attribute: with references in place of characters that XML reserves.
/// @throws std::invalid_argument if it has a character that XML cannot hold
[[nodiscard]] inline std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\t':
      case '\n':
      case '\r':
        result += "&#" + std::to_string(static_cast<int>(c)) + ";";
        break;
      default:
        if (c >= 0 && c < ' ') {
          throw std::invalid_argument("the text '" + std::string(text) +
                                      "' has a control character, which XML cannot hold");
        }
        result += c;
    }
  }
  return result;
}

/// XML as it is put together. Every element is on a line of its own, indented by its depth.
class XmlText {
 public:
  /// An attribute: a name and a text, a number, or numbers.
  struct Attribute {
    std::string name;
    std::string value;

    Attribute(std::string key, std::string_view text) : name(std::move(key)), value(text) {}
    Attribute(std::string key, double number)
        : name(std::move(key)), value(number_text(number + 0.0)) {}  // + 0.0: no minus zero
    Attribute(std::string key, double x, double y, double z)
        : name(std::move(key)),
          value(number_text(x + 0.0) + " " + number_text(y + 0.0) + " " + number_text(z + 0.0)) {}
  };

  /// Opens an element; what follows is inside of it until `close`.
  void open(std::string_view name, const std::vector<Attribute>& attributes = {}) {
    begin(name, attributes);
    text_ += ">\n";
    open_.emplace_back(name);
  }
  /// Adds an element without contents.
  void add(std::string_view name, const std::vector<Attribute>& attributes = {}) {
    begin(name, attributes);
    text_ += "/>\n";
  }
  /// Closes the element that was opened last.
  void close() {
    const std::string name = open_.back();
    open_.pop_back();
    text_ += std::string(2 * open_.size(), ' ') + "</" + name + ">\n";
  }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  void begin(std::string_view name, const std::vector<Attribute>& attributes) {
    text_ += std::string(2 * open_.size(), ' ') + "<" + std::string(name);
    for (const Attribute& attribute : attributes) {
      text_ += " " + attribute.name + "=\"" + xml_escaped(attribute.value) + "\"";
    }
  }

  std::string text_{"<?xml version=\"1.0\"?>\n"};
  std::vector<std::string> open_{};
};

}  // namespace articula::detail
