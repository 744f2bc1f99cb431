// SPDX-License-Identifier: Apache-2.0
/// @file Words in a URDF that nobody reads, for they may be misspelt.
#pragma once

#include "articula/text/meant_word.hpp"
#include "articula/urdf/xml/grouped_lines.hpp"
#include "articula/urdf/xml/known_words.hpp"
#include "articula/urdf/xml/xml.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace articula::detail {

/// Collects the attributes and child elements of a robot's links and joints that URDF does not
/// know: urdfdom passes them over in silence. Each word has one line, with the first link or joint
/// that has it and how many others do. Elements that tell nothing of mechanics are not looked into.
class UnknownWords {
 public:
  explicit UnknownWords(const XmlElement& robot) {
    for (const char* kind : {"link", "joint"}) {
      for_each_child(robot, kind, [&](const XmlElement& element) {
        owner_ = std::string(kind) + " '" + one_line(attribute(element, "name")) + "': ";
        look_at(element);
      });
    }
  }

  [[nodiscard]] std::vector<std::string> take() const { return lines_.take(); }

 private:
  void look_at(const XmlElement& element) {
    const KnownWords* known = known_words(element.Value());
    if (!known) return;
    const auto is_known = [](const auto& words, std::string_view word) {
      return std::find(words.begin(), words.end(), word) != words.end();
    };
    for (auto each = element.FirstAttribute(); each; each = each->Next()) {
      const std::string name = each->Name();
      if (is_known(known->attributes, name)) continue;
      add(*known, name, "attribute '", meant_word(name, known->attributes), "'");
    }
    for_each_child(element, nullptr, [&](const XmlElement& child) {
      const std::string name = child.Value();
      if (is_known(known->children, name)) return look_at(child);
      add(*known, name, "element <", meant_word(name, known->children), ">");
    });
  }

  /// Words with a colon belong to others, and xmlns says to whom.
  void add(const KnownWords& place, const std::string& word, const std::string& open,
           std::string_view meant, const char* close) {
    if (word.find(':') != std::string::npos || word == "xmlns") return;
    std::string line = "<" + std::string(place.element) + ">: the " + open + word + close +
                       " is not known there and does not count";
    if (!meant.empty()) {
      line += std::string("; did you mean ") + open.back() + std::string(meant) + close + "?";
    }
    lines_.add(owner_, line);
  }

  GroupedLines lines_{};
  std::string owner_{};  ///< the link or joint, for the lines
};

/// What may be behind a fault, as an addition to its message: the first word that is not known in a
/// link or joint that the message names.
[[nodiscard]] inline std::string perhaps_because_of(const std::vector<std::string>& unknown_words,
                                                    std::string_view message) {
  for (const std::string& line : unknown_words) {  // link 'name': ...
    const std::size_t begin = line.find('\'') + 1;
    const std::string name = line.substr(begin, line.find('\'', begin) - begin);
    if (message.find("'" + name + "'") != std::string_view::npos ||
        message.find("[" + name + "]") != std::string_view::npos) {
      return "; perhaps because of this: " + line;
    }
  }
  return "";
}

}  // namespace articula::detail
